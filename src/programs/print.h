// Records of the document's C interface as the field's programs print them: scripts read this text.
#pragma once

#include <cstdio>

#include "trk_struct.h"

namespace trk_bridge::programs {

/// A block each: a heading, a line a field with a tab before it, an empty line. Numbers have six digits.
void print(std::FILE* out, const trkCameraConstants&);
void print(std::FILE* out, const trkCameraParams&);

}  // namespace trk_bridge::programs
