// Records of the document's C interface as lines for a person.
#pragma once

#include <trk/trk_struct.h>

#include <iosfwd>

namespace trk_bridge::programs {

/// One line each, written out at once; numbers with the fewest digits that read back to the same value.
void print(std::ostream&, const trkCameraConstants&);
void print(std::ostream&, const trkCameraParams&);

}  // namespace trk_bridge::programs
