// A measurement as a drawing.
#pragma once

#include <string>

#include "meter.h"

namespace trk_bridge::delay {

/// An SVG: how fast the picture and tracking turned about the axis that moved most, as stamped and with tracking
/// delayed, in the ten seconds about the quickest moment; below, the correlation over all delays. The measurement must
/// have speeds. `title` is written above.
std::string to_svg(const Measurement&, const std::string& title);

}  // namespace trk_bridge::delay
