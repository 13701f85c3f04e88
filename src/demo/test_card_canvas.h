// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Draws lines, discs and text on a grey picture with subpixel accuracy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace trk_bridge::demo {

/// Draws on a picture with 8 bits per pixel that it does not own. Positions are in pixels, ROS coordinates; parts
/// outside the picture are clipped. Edges are soft over three pixels, so that the centres of lines and discs are kept
/// with subpixel accuracy, also when the picture is resampled; the drawing functions of OpenCV do not do this.
class Canvas {
 public:
  Canvas(cv::Mat& picture, std::uint8_t background);

  void clear();
  /// Where lines cross, the brighter one is visible. `half_width` must be at least 1.5.
  void line(const std::vector<Eigen::Vector2d>& polyline, double half_width, std::uint8_t level);
  void disc(const Eigen::Vector2d& center, double radius, std::uint8_t level);
  /// Beside a disc of `radius` at `center`, where nothing has been drawn yet; not drawn if there is no free place.
  void label(const std::string& text, const Eigen::Vector2d& center, double radius, std::uint8_t level);

 private:
  void segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_width, std::uint8_t level);
  bool is_free(const cv::Rect& area) const;

  cv::Mat& picture_;
  std::uint8_t background_;
};

}  // namespace trk_bridge::demo
