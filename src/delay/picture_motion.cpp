// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "picture_motion.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace trk_bridge::delay {
namespace {

// Sizes are pixels of the reduced picture.
constexpr int width_for_points = 640, width_for_whole = 320;  // at most
constexpr int most_points = 200;
constexpr double weakest_corner = 0.01;  // of the strongest
constexpr int points_across = 24;        // largest number of points in a row
constexpr float same_motion = 2;
constexpr int halvings = 2;  // of the picture, for points that move differently from it

cv::Mat reduced(const cv::Mat& picture, int most_width) {
  cv::Mat result;
  if (picture.cols <= most_width) {
    picture.copyTo(result);
  } else {
    const double scale = static_cast<double>(most_width) / picture.cols;
    cv::resize(picture, result, {}, scale, scale, cv::INTER_AREA);
  }
  return result;
}

}  // namespace

cv::Point2f PictureMotion::correlated_motion() {
  if (window_.size() != small_now_.size()) cv::createHanningWindow(window_, small_now_.size(), CV_32F);
  // Copies, because OpenCV 4.6 multiplies its input by the window.
  small_before_.convertTo(correlated_before_, CV_32F);
  small_now_.convertTo(correlated_now_, CV_32F);
  const cv::Point2d moved = cv::phaseCorrelate(correlated_before_, correlated_now_, window_);
  return moved * (static_cast<double>(now_.cols) / small_now_.cols);
}

PictureMotion::Followed PictureMotion::follow(const cv::Point2f& whole) const {
  Followed followed{whole, points_, {}, 0};
  for (auto& point : followed.points) point += whole;
  std::vector<float> differences;
  cv::calcOpticalFlowPyrLK(before_, now_, points_, followed.points, followed.is_found, differences, {15, 15}, halvings,
                           {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.005}, cv::OPTFLOW_USE_INITIAL_FLOW);
  const cv::Rect2f seen({}, cv::Size2f(now_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!seen.contains(followed.points[i])) followed.is_found[i] = 0;
    if (followed.is_found[i] == 0) differences[i] = std::numeric_limits<float>::infinity();
  }
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  followed.difference = *middle;
  return followed;
}

const std::vector<MovedPoint>& PictureMotion::next(const cv::Mat& grey) {
  moved_.clear();
  std::swap(before_, now_);
  std::swap(small_before_, small_now_);
  now_ = reduced(grey, width_for_points);
  small_now_ = reduced(now_, width_for_whole);
  if (std::exchange(size_, grey.size()) != grey.size()) return moved_;

  const int distance = std::max(now_.cols / points_across, 1);
  cv::goodFeaturesToTrack(before_, points_, most_points, weakest_corner, distance, cv::noArray(), 5);
  if (points_.empty()) return moved_;
  Followed followed = follow(correlated_motion());
  // Grids match at wrong places, and noise can hide the peak: so the motion of the last frame is tried as well.
  if (cv::norm(followed.whole - whole_) > same_motion) {
    Followed other = follow(whole_);
    if (other.difference < followed.difference) followed = std::move(other);
  }
  whole_ = followed.whole;
  const double scale = static_cast<double>(grey.cols) / now_.cols;
  const auto to_frame = [scale](const cv::Point2f& point) {
    return Eigen::Vector2d((point.x + 0.5) * scale - 0.5, (point.y + 0.5) * scale - 0.5);
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (followed.is_found[i] != 0) moved_.push_back({to_frame(points_[i]), to_frame(followed.points[i])});
  }
  return moved_;
}

}  // namespace trk_bridge::delay
