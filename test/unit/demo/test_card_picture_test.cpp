// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The drawing is where the camera sees it: points compared with the worked cases, lines with OpenCV and the fitted
// distortion.
#include "demo/test_card_picture.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "../camera/worked_cases.h"
#include "picture_measure.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::demo::test_card_picture_test {

using test::deviation_from_straight;
using test::disc_center;
using test::line_centers;

constexpr double point_limit = 0.05;     // pixels between a point and where CameraInfo says
constexpr double straight_limit = 0.1;   // pixels between a rectified line and a straight one
constexpr double drawing_limit = 0.005;  // pixels: error of a disc's centroid because of the drawing

cv::Mat blank(const wire::CameraConstants& constants) {
  return cv::Mat(constants.image_height, constants.image_width, CV_8UC1);
}

TEST(TestCardPicture, HasThePointsOfTheWorkedCasesWhereTheCameraSeesThem) {
  int compared = 0;
  double worst = 0;
  for (const auto& c : test::worked_cases()) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto view = View::of(c.params, c.constants);
    ASSERT_TRUE(view) << camera::describe(view.error());
    for (const auto& point : c.points) {
      Figure figure;
      figure.points.push_back({point.studio, "a label must not disturb it"});
      cv::Mat picture = blank(c.constants);
      draw(figure, *view, picture);
      if (!test::is_inside(picture, point.distorted, clear_radius)) continue;
      const auto found = disc_center(picture, point.distorted);
      ASSERT_TRUE(found);
      worst = std::max(worst, (*found - point.distorted).norm());
      ++compared;
    }
  }
  EXPECT_LT(worst, drawing_limit) << "pixels";
  EXPECT_GT(compared, 256);
  RecordProperty("worst_point_pixels", std::to_string(worst));
}

/// A camera and a lens that see the complete card.
struct Sight {
  const char* name;
  double x, y, z, pan, tilt, roll;
  double image_distance, k1, k2, center_x, center_y;
  int blank_left, blank_right, blank_top, blank_bottom;
};

// Barrel distortion moves the corners of this chip by about 60 pixels (distorted to undistorted: k1 above 0),
// pincushion by the same.
constexpr Sight sights[] = {
    {"Barrel", 0, 0, 1.7, 0, 0, 0, 9, 2e-3, 5e-6, 0, 0, 0, 0, 0, 0},
    {"BarrelFromAboveAslant", -3, 2, 4, -20, -18, 7, 8, 1.7e-3, 4e-6, 0.05, -0.03, 0, 0, 0, 0},
    {"Cushion", 1, -1, 1.5, 5, -3, -4, 10, -1.5e-3, -3e-6, 0, 0, 0, 0, 0, 0},
    {"CushionShifted", 2, 1, 2.2, 12, -6, 25, 14, -1.2e-3, 0, -0.4, 0.3, 0, 0, 0, 0},
    {"BarrelShiftedWithBlanks", -1, 0, 2, -4, -8, 0, 9, 1.8e-3, 4e-6, 0.3, -0.2, 120, 40, 30, 80},
    {"Long", 0, -5, 1.6, 2, 1, -8, 46, -1.2e-4, 0, 0.01, -0.008, 0, 0, 0, 0},
};

wire::CameraConstants constants_for(const Sight& sight) {
  wire::CameraConstants constants;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.blank_left = sight.blank_left;
  constants.blank_right = sight.blank_right;
  constants.blank_top = sight.blank_top;
  constants.blank_bottom = sight.blank_bottom;
  constants.chip_width = 9.59 * (1920 - sight.blank_left - sight.blank_right) / 1920;
  constants.chip_height = 5.39 * (1080 - sight.blank_top - sight.blank_bottom) / 1080;
  return constants;
}

wire::CameraParams params_for(const Sight& sight) {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler = {sight.x, sight.y, sight.z, sight.pan, sight.tilt, sight.roll};
  params.fov = sight.image_distance;
  params.center_x = sight.center_x;
  params.center_y = sight.center_y;
  params.k1 = sight.k1;
  params.k2 = sight.k2;
  return params;
}

class TestCardThroughLens : public ::testing::TestWithParam<Sight> {
 protected:
  void SetUp() override {
    const auto seen = View::of(params_, constants_);
    ASSERT_TRUE(seen) << camera::describe(seen.error());
    view_ = *seen;
    picture_ = blank(constants_);
    draw(figure_, *view_, picture_);
    const auto camera = camera::decode(params_, &constants_);
    ASSERT_TRUE(camera);
    optical_T_studio_ = (camera->pose * camera_T_optical()).inverse();
    camera::Calibrator calibrator;
    const auto calibration = calibrator.calibrate(camera->lens, constants_);
    ASSERT_TRUE(calibration) << camera::describe(calibration.error());
    k_ = cv::Mat(3, 3, CV_64F, const_cast<double*>(calibration->k.data())).clone();
    const auto& d = calibration->distortion;
    d_ = cv::Mat(1, d.model == camera::DistortionModel::plumb_bob ? 5 : 8, CV_64F, const_cast<double*>(d.d.data()))
             .clone();
  }

  /// Independent of the code under test: x right, y down, z forward.
  static Eigen::Isometry3d camera_T_optical() {
    Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
    transform.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return transform;
  }

  /// With OpenCV; none behind the camera.
  std::optional<Eigen::Vector2d> projected(const Eigen::Vector3d& studio, const cv::Mat& d) const {
    const Eigen::Vector3d p = optical_T_studio_ * studio;
    if (p.z() < 0.1) return std::nullopt;
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(), k_, d, pixels);
    return Eigen::Vector2d(pixels[0].x, pixels[0].y);
  }

  /// A line's two ends through a lens without distortion; none if no part of it is in front of the camera.
  std::vector<Eigen::Vector2d> pinhole_line(Line line) const {
    const auto depth = [&](const Eigen::Vector3d& p) { return (optical_T_studio_ * p).z(); };
    if (depth(line.from) > depth(line.to)) std::swap(line.from, line.to);
    constexpr double nearest = 0.2;
    if (depth(line.to) <= nearest) return {};
    if (const double begin = depth(line.from); begin < nearest) {
      line.from += (nearest - begin) / (depth(line.to) - begin) * (line.to - line.from);
    }
    return {*projected(line.from, {}), *projected(line.to, {})};
  }

  std::vector<Line> lines() const {
    std::vector<Line> all = figure_.floor;
    all.insert(all.end(), figure_.wall.begin(), figure_.wall.end());
    return all;
  }

  wire::CameraConstants constants_ = constants_for(GetParam());
  wire::CameraParams params_ = params_for(GetParam());
  Figure figure_ = figure_at({});
  std::optional<View> view_;
  Eigen::Isometry3d optical_T_studio_;
  cv::Mat picture_, k_, d_;
};

TEST_P(TestCardThroughLens, PointsAreWhereCameraInfoSays) {
  int compared = 0;
  double worst = 0, without_distortion = 0;
  for (const Point& point : figure_.points) {
    const auto expected = projected(point.place, d_), pinhole = projected(point.place, {});
    // The fit is valid in the image; outside, OpenCV's polynomial may map any point into it.
    const auto seen = view_->see(point.place);
    if (!expected || !seen || !test::is_inside(picture_, *seen, clear_radius)) continue;
    const auto found = disc_center(picture_, *expected);
    if (!found) continue;  // another point is too near
    worst = std::max(worst, (*found - *expected).norm());
    without_distortion = std::max(without_distortion, (*found - *pinhole).norm());
    ++compared;
  }
  EXPECT_GE(compared, 4);
  EXPECT_LT(worst, point_limit) << "pixels";
  EXPECT_GT(without_distortion, 10 * point_limit) << "pixels: otherwise nothing was tested";
  RecordProperty("worst_point_pixels", std::to_string(worst));
  RecordProperty("points", compared);
}

TEST_P(TestCardThroughLens, RectifiedLinesAreStraight) {
  cv::Mat map1, map2, rectified;
  cv::initUndistortRectifyMap(k_, d_, cv::Mat(), k_, picture_.size(), CV_32FC1, map1, map2);
  cv::remap(picture_, rectified, map1, map2, cv::INTER_LINEAR);
  int compared = 0;
  double worst = 0, worst_place = 0, raw = 0;
  Polyline bent;
  for (const Line& line : lines()) {
    const auto expected = pinhole_line(line);
    const auto found = line_centers(rectified, expected);
    if (found.size() < 20) continue;
    worst = std::max(worst, deviation_from_straight(found));
    const Eigen::Vector2d along = (expected[1] - expected[0]).normalized();
    for (const auto& center : found) {
      const Eigen::Vector2d offset = center - expected[0];
      worst_place = std::max(worst_place, std::abs(along.x() * offset.y() - along.y() * offset.x()));
    }
    view_->see(line, bent);
    raw = std::max(raw, deviation_from_straight(line_centers(picture_, bent)));
    ++compared;
  }
  EXPECT_GE(compared, 4);
  EXPECT_LT(worst, straight_limit) << "pixels";
  EXPECT_LT(worst_place, straight_limit) << "pixels from the line of a pinhole camera";
  EXPECT_GT(raw, 5 * straight_limit) << "pixels: otherwise nothing was tested";
  RecordProperty("worst_line_pixels", std::to_string(worst));
  RecordProperty("worst_line_place_pixels", std::to_string(worst_place));
  RecordProperty("lines", compared);
}

TEST_P(TestCardThroughLens, ChordsFollowTheCurve) {
  Polyline bent;
  double worst = 0;
  for (const Line& line : lines()) {
    view_->see(line, bent);
    std::size_t chord = 0;
    constexpr int samples = 20000;
    for (int i = 0; i <= samples; ++i) {
      const auto seen = view_->see(line.from + double(i) / samples * (line.to - line.from));
      if (!seen || bent.size() < 2 || !test::is_inside(picture_, *seen, 1)) continue;
      const auto distance = [&](std::size_t at) {
        const Eigen::Vector2d along = bent[at + 1] - bent[at];
        const double part = std::clamp((*seen - bent[at]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        return (bent[at] + part * along - *seen).norm();
      };
      // The ends of the polyline may be in the opposite order.
      double nearest = distance(chord);
      for (std::size_t at = 0; at + 1 < bent.size() && nearest > 0.02; ++at) {
        if (distance(at) < nearest) nearest = distance(chord = at);
      }
      worst = std::max(worst, nearest);
    }
  }
  EXPECT_LT(worst, 0.02) << "pixels";
  EXPECT_GT(worst, 0);
}

INSTANTIATE_TEST_SUITE_P(Sights, TestCardThroughLens, ::testing::ValuesIn(sights),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace trk_bridge::demo::test_card_picture_test
