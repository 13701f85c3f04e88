// `trk lens`: what a lens table says, and its curves.
#pragma once

#include <string>
#include <vector>

#include "lens/table.h"

namespace trk_bridge::tools {

/// A line each: ranges of encoders, focal length, angle of view, shift and distortion, focus; what is not known.
std::vector<std::string> lines_of(const lens::Table&);

/// An SVG: focal length, centre shift and distortion over zoom, for the first and the last focus where that matters;
/// the focus distance over focus where it is known.
std::string to_svg(const lens::Table&, const std::string& title);

}  // namespace trk_bridge::tools
