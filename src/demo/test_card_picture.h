// The test card as a camera sees it.
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "test_card_figure.h"
#include "test_card_view.h"

namespace trk_bridge::demo {

/// Levels of grey, 0 to 255, and sizes in pixels, whatever the lens.
inline constexpr std::uint8_t background = 30, floor_level = 150, wall_level = 205, point_level = 255,
                              label_level = 170;
inline constexpr double line_half_width = 1.5;
inline constexpr double point_radius = 7;   ///< of a point's disc
inline constexpr double clear_radius = 16;  ///< about a point, where no line is drawn

/// Draws `figure` over the whole of `picture`: CV_8UC1, of the size of `view`. Points are round discs about the very
/// pixel where the camera sees them, so that the disc's centroid is the point, which that of a disc in the studio would
/// not be.
void draw(const Figure& figure, const View& view, cv::Mat& picture);

}  // namespace trk_bridge::demo
