// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The test programs of the document (section 6.2), which use the C interface. Usage, output and exit codes are those of
// existing programs, because scripts rely on them.
#pragma once

namespace trk_bridge::programs {

/// Runs the program of this name (a line of the table in programs.cpp) with the arguments of main(), and returns its
/// exit status: 0 for success, 1 with a message on standard error for a failure.
int run(const char* name, int argc, char** argv);

}  // namespace trk_bridge::programs
