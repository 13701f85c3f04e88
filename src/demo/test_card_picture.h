// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Draws the test card as a camera sees it.
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "test_card_figure.h"
#include "test_card_view.h"

namespace trk_bridge::demo {

/// Grey levels, 0 to 255, and sizes in pixels, independent of the lens.
inline constexpr std::uint8_t background = 30, floor_level = 150, wall_level = 205, point_level = 255,
                              label_level = 170;
inline constexpr double line_half_width = 1.5;
inline constexpr double point_radius = 7;   ///< of the disc of a point
inline constexpr double clear_radius = 16;  ///< around a point, where no line is drawn

/// Draws `figure` over all of `picture`: CV_8UC1, with the size of `view`. Points are round discs around the exact
/// pixel position where the camera sees them, so that the centroid of a disc is the point; this would not be true for a
/// disc in the studio.
void draw(const Figure& figure, const View& view, cv::Mat& picture);

}  // namespace trk_bridge::demo
