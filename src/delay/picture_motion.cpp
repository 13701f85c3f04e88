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
constexpr int points_across = 24;        // no more than so many in a row
constexpr int halvings = 2;              // of the picture, for points that move otherwise than the whole

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

/// Mean difference between what two pictures show of the same, if the second one has moved by so much.
double difference(const cv::Mat& before, const cv::Mat& now, const cv::Point2d& moved) {
  const cv::Point by(cvRound(moved.x), cvRound(moved.y));
  const cv::Rect all({}, before.size());
  const cv::Rect seen_now = all & (all + by);
  if (seen_now.empty()) return std::numeric_limits<double>::infinity();
  return cv::norm(before(seen_now - by), now(seen_now), cv::NORM_L1) / seen_now.area();
}

}  // namespace

cv::Point2d PictureMotion::whole_motion() {
  if (window_.size() != small_now_.size()) cv::createHanningWindow(window_, small_now_.size(), CV_32F);
  // Copies: OpenCV 4.6 multiplies what it is given by the window.
  small_before_.convertTo(correlated_before_, CV_32F);
  small_now_.convertTo(correlated_now_, CV_32F);
  const cv::Point2d correlated = cv::phaseCorrelate(correlated_before_, correlated_now_, window_);
  // Noise can hide the peak of a picture with little in it: then the motion goes on.
  if (difference(small_before_, small_now_, correlated) < difference(small_before_, small_now_, whole_)) {
    whole_ = correlated;
  }
  return whole_ * (static_cast<double>(now_.cols) / small_now_.cols);
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
  const cv::Point2f whole = whole_motion();
  found_ = points_;
  for (auto& point : found_) point += whole;
  cv::calcOpticalFlowPyrLK(before_, now_, points_, found_, is_found_, errors_, {15, 15}, halvings,
                           {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.005}, cv::OPTFLOW_USE_INITIAL_FLOW);
  const double scale = static_cast<double>(grey.cols) / now_.cols;
  const auto to_frame = [scale](const cv::Point2f& point) {
    return Eigen::Vector2d((point.x + 0.5) * scale - 0.5, (point.y + 0.5) * scale - 0.5);
  };
  const cv::Rect2f seen({}, cv::Size2f(now_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (is_found_[i] != 0 && seen.contains(found_[i])) moved_.push_back({to_frame(points_[i]), to_frame(found_[i])});
  }
  return moved_;
}

}  // namespace trk_bridge::delay
