// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Pictures moved by a known distance.
#include "delay/picture_motion.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace trk_bridge::delay::picture_motion_test {

/// A part of a large picture, so that new content appears at its edge.
cv::Mat part(double x, double y, cv::Size size) {
  static const cv::Mat large = [] {
    cv::Mat picture(900, 1600, CV_8UC1);
    cv::RNG(11).fill(picture, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(picture, picture, {0, 0}, 1.5);
    cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
    return picture;
  }();
  cv::Mat seen;
  const cv::Mat to_part = (cv::Mat_<double>(2, 3) << 1, 0, -x, 0, 1, -y);
  cv::warpAffine(large, seen, to_part, size, cv::INTER_CUBIC);
  return seen;
}

Eigen::Vector2d median_motion(const std::vector<MovedPoint>& points) {
  std::vector<double> right, down;
  for (const auto& point : points) {
    right.push_back((point.now - point.before).x());
    down.push_back((point.now - point.before).y());
  }
  const auto middle = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  return {middle(right), middle(down)};
}

TEST(PictureMotion, IsFoundForAnyDistance) {
  for (const cv::Size size : {cv::Size(320, 180), cv::Size(1280, 720)}) {
    for (const cv::Point2d by : {cv::Point2d(0, 0), {0.37, -0.6}, {-7.3, 2}, {41.5, -12.25}}) {
      PictureMotion motion;
      EXPECT_TRUE(motion.next(part(150, 80, size)).empty()) << "the first frame";
      const auto points = motion.next(part(150 - by.x, 80 - by.y, size));
      ASSERT_GT(points.size(), 50U);
      const auto found = median_motion(points);
      EXPECT_NEAR(found.x(), by.x, 0.1) << size;
      EXPECT_NEAR(found.y(), by.y, 0.1) << size;
    }
  }
}

TEST(PictureMotion, IsNoneWithoutDetail) {
  PictureMotion motion;
  const cv::Mat grey(180, 320, CV_8UC1, cv::Scalar(90));
  motion.next(grey);
  EXPECT_TRUE(motion.next(grey).empty());
  EXPECT_TRUE(motion.next(part(0, 0, {640, 360})).empty()) << "another size";
}

}  // namespace trk_bridge::delay::picture_motion_test
