// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Prints records of the document's C interface in the same text as existing programs: scripts parse it.
#pragma once

#include <cstdio>

#include "trk_struct.h"

namespace trk_bridge::programs {

/// One block: a heading, one line per field that begins with a tab, an empty line. Numbers have six digits.
void print(std::FILE* out, const trkCameraConstants&);
void print(std::FILE* out, const trkCameraParams&);

}  // namespace trk_bridge::programs
