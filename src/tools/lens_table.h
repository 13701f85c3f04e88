// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk lens`: describes and plots a lens table.
#pragma once

#include <string>
#include <vector>

#include "lens/table.h"

namespace trk_bridge::tools {

/// Lines with the ranges of encoders, focal length, angle of view, shift, distortion and focus, and what is not known.
std::vector<std::string> lines_of(const lens::Table&);

/// An SVG: focal length, centre shift and distortion over zoom, for the first and the last focus if they differ; the
/// focus distance over focus if it is known.
std::string to_svg(const lens::Table&, const std::string& title);

}  // namespace trk_bridge::tools
