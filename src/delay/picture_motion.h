// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures how points of a picture have moved since the picture before.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace trk_bridge::delay {

/// A point of the scene in two successive frames, pixels in ROS coordinates (origin in the centre of the top left one,
/// y down).
struct MovedPoint {
  Eigen::Vector2d before, now;
};

/// Follows points from frame to frame. Phase correlation gives the motion of the whole picture, however large; from
/// there, single points are followed with subpixel accuracy (Lucas and Kanade). Points are spread over the picture, so
/// that a small object with much detail has few of them. Not synchronised.
class PictureMotion {
 public:
  /// `grey` is CV_8UC1 and is not kept. Returns the points that were found again, in any order: none for the first
  /// frame, for a frame with a new size, or if the picture has no detail. Some points may move with objects instead of
  /// the camera, and some may be wrong. The result is valid until the next call.
  const std::vector<MovedPoint>& next(const cv::Mat& grey);

 private:
  /// The current positions of points that are near the position expected from the motion of the whole picture.
  struct Followed {
    cv::Point2f whole;
    std::vector<cv::Point2f> points;
    std::vector<unsigned char> is_found;
    float difference = 0;  // of the surroundings of a point before and now, grey levels; median over the points
  };

  cv::Point2f correlated_motion();
  Followed follow(const cv::Point2f& whole) const;

  cv::Size size_;
  cv::Mat before_, now_;              // reduced
  cv::Mat small_before_, small_now_;  // reduced further, for phase correlation
  cv::Mat correlated_before_, correlated_now_, window_;
  cv::Point2f whole_;  // motion from before_ to now_
  std::vector<cv::Point2f> points_;
  std::vector<MovedPoint> moved_;
};

}  // namespace trk_bridge::delay
