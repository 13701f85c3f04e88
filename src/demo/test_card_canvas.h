// Lines, discs and words on a grey picture, exact to a small part of a pixel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace trk_bridge::demo {

/// Draws on a picture of 8 bits a pixel that it does not own. Positions are in pixels, ROS coordinates; what lies
/// outside is left away. Edges are soft over three pixels, so that the picture keeps the centres of lines and discs
/// wherever they fall between pixels, also when it is resampled; OpenCV's own drawing does not.
class Canvas {
 public:
  Canvas(cv::Mat& picture, std::uint8_t background);

  void clear();
  /// Where lines cross the brighter counts. `half_width` is at least 1.5.
  void line(const std::vector<Eigen::Vector2d>& polyline, double half_width, std::uint8_t level);
  void disc(const Eigen::Vector2d& center, double radius, std::uint8_t level);
  /// Beside a disc of `radius` at `center` where nothing has been drawn yet; nowhere if there is no such place.
  void label(const std::string& text, const Eigen::Vector2d& center, double radius, std::uint8_t level);

 private:
  void segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_width, std::uint8_t level);
  bool is_free(const cv::Rect& area) const;

  cv::Mat& picture_;
  std::uint8_t background_;
};

}  // namespace trk_bridge::demo
