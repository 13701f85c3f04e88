// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Built once for each program: TRK_BRIDGE_PROGRAM is its name.
#include "programs.h"

int main(int argc, char** argv) { return trk_bridge::programs::run(TRK_BRIDGE_PROGRAM, argc, argv); }
