// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Drawing is exact between pixels.
#include "demo/test_card_canvas.h"

#include <cmath>

#include <gmock/gmock.h>

#include "picture_measure.h"

namespace trk_bridge::demo::test_card_canvas_test {

constexpr std::uint8_t ground = 30, bright = 255;

class TestCardCanvas : public ::testing::Test {
 protected:
  TestCardCanvas() { canvas_.clear(); }
  double brightest() const {
    double most = 0;
    cv::minMaxLoc(picture_, nullptr, &most);
    return most;
  }

  cv::Mat picture_{cv::Mat(240, 320, CV_8UC1)};
  Canvas canvas_{picture_, ground};
};

TEST_F(TestCardCanvas, DiscsHaveTheirCentroidWhereTheyWereDrawn) {
  for (int i = 0; i < 400; ++i) {
    // Steps of the golden ratio: all fractions of a pixel, and none twice.
    const Eigen::Vector2d center(100 + std::fmod(i * 0.6180339887, 1), 80 + std::fmod(i * 0.7548776662, 1));
    canvas_.clear();
    canvas_.disc(center, 7, bright);
    const auto found = test::disc_center(picture_, center + Eigen::Vector2d(0.3, -0.3));
    ASSERT_TRUE(found);
    EXPECT_LT((*found - center).norm(), 0.005) << center.transpose();
  }
}

TEST_F(TestCardCanvas, LinesHaveTheirMiddleWhereTheyWereDrawnAtAnyAngle) {
  double worst = 0, worst_mean = 0;
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double angle = degrees * M_PI / 180;
    const Eigen::Vector2d middle(160 + degrees * 0.0173, 120 - degrees * 0.0241),
        direction(std::cos(angle), std::sin(angle)), normal(-direction.y(), direction.x());
    const std::vector<Eigen::Vector2d> line{middle - 500 * direction, middle + 10 * direction,
                                            middle + 500 * direction};
    canvas_.clear();
    canvas_.line(line, 1.5, bright);
    const auto found = test::line_centers(picture_, {line.front() + 0.7 * normal, line.back() + 0.7 * normal});
    ASSERT_GT(found.size(), 30u);
    double sum = 0;
    for (const auto& center : found) {
      sum += normal.dot(center - middle);
      worst = std::max(worst, std::abs(normal.dot(center - middle)));
    }
    worst_mean = std::max(worst_mean, std::abs(sum) / static_cast<double>(found.size()));
  }
  EXPECT_LT(worst_mean, 0.005) << "pixels over the complete line";
  EXPECT_LT(worst, 0.03) << "pixels of one crossing";
}

TEST_F(TestCardCanvas, LinesEndWhereTheyShould) {
  canvas_.line({{100, 100}, {200, 100}}, 1.5, bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(100, 100), bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(100, 96), ground);
  EXPECT_EQ(picture_.at<std::uint8_t>(100, 204), ground);
  EXPECT_EQ(picture_.at<std::uint8_t>(97, 150), ground);
  EXPECT_EQ(picture_.at<std::uint8_t>(103, 150), ground);
}

TEST_F(TestCardCanvas, PartsOutsideAreClipped) {
  for (const double far : {330.0, 1e5, 1e9, 1e300}) {
    canvas_.line({{-far, -far}, {-far, far}}, 1.5, bright);
    canvas_.line({{far, far}, {far, far}}, 1.5, bright);
    canvas_.disc({far, 100}, 7, bright);
    canvas_.disc({100, -far}, 7, bright);
    canvas_.label("far", {far, far}, 7, bright);
    canvas_.label("far", {-far, 100}, 7, bright);
  }
  EXPECT_EQ(brightest(), ground);
}

TEST_F(TestCardCanvas, AcrossAnEdgeThePartInsideIsDrawn) {
  canvas_.disc({0, 0}, 7, bright);
  canvas_.disc({319, 239}, 7, bright);
  canvas_.line({{-50, 120}, {400, 120}}, 1.5, bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(0, 0), bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(239, 319), bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(120, 0), bright);
  EXPECT_EQ(picture_.at<std::uint8_t>(120, 319), bright);
}

TEST_F(TestCardCanvas, LabelsAvoidDrawnParts) {
  canvas_.line({{0, 125}, {320, 125}}, 1.5, bright);
  const cv::Mat before = picture_.clone();
  canvas_.label("4 8 2", {160, 110}, 7, bright);
  EXPECT_GT(cv::countNonZero(picture_ != before), 50) << "above the line";
  const cv::Mat labelled = picture_.clone();
  EXPECT_EQ(cv::countNonZero(picture_.rowRange(110, 240) != before.rowRange(110, 240)), 0) << "not on it";
  // Without a free place above or below, no label is drawn.
  cv::Mat full(240, 320, CV_8UC1, cv::Scalar(bright));
  Canvas(full, ground).label("4 8 2", {160, 110}, 7, ground);
  EXPECT_EQ(cv::countNonZero(full != cv::Mat(240, 320, CV_8UC1, cv::Scalar(bright))), 0);
}

}  // namespace trk_bridge::demo::test_card_canvas_test
