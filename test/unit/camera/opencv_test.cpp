// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The published K and D with OpenCV.
#include <gmock/gmock.h>

#include <opencv2/calib3d.hpp>

#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"
#include "worked_cases.h"

namespace trk_bridge::camera::opencv_test {

constexpr double tolerance = 0.02;

Eigen::Vector2d opencv_pixel(const Calibration& calibration, const Eigen::Vector3d& optical) {
  const cv::Matx33d k(calibration.k.data());
  const auto& d = calibration.distortion;
  const std::vector<double> coefficients(d.d.begin(), d.d.begin() + (d.model == DistortionModel::plumb_bob ? 5 : 8));
  const std::vector<cv::Point3d> points = {{optical.x(), optical.y(), optical.z()}};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), k, coefficients, pixels);
  return {pixels[0].x, pixels[0].y};
}

Eigen::Vector3d to_optical(const Eigen::Vector3d& camera) { return {camera.x(), -camera.z(), camera.y()}; }

TEST(OpenCv, PutsThePointsOfTheWorkedCasesWhereTheCameraSeesThem) {
  double worst = 0;
  for (const auto& c : test::worked_cases()) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto camera = decode(c.params, &c.constants);
    ASSERT_TRUE(camera) << describe(camera.error());
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(camera->lens, c.constants);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    for (const auto& point : c.points) {
      const Eigen::Vector2d pixel = opencv_pixel(*calibration, to_optical(camera->pose.inverse() * point.studio));
      const double error = (pixel - point.distorted).norm();
      EXPECT_LE(error, tolerance) << pixel.transpose() << " instead of " << point.distorted.transpose();
      EXPECT_LE(error, calibration->distortion.residual + 1e-6) << "the error is larger than the residual";
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst_pixels", std::to_string(worst));
}

TEST(OpenCv, MatchesTheFullImageWithinTheResidual) {
  // A wide lens with everything: pixels that are not square, different blanks, an axis off the centre.
  const wire::CameraConstants constants{0, 720, 576, 4, 12, 6, 0, 9.59, 7.19, 0, 0};
  const Lens lens{5.2, {0.31, -0.22}, 2e-3, 3e-5, 0, 0};
  Calibrator calibrator;
  const auto calibration = calibrator.calibrate(lens, constants);
  ASSERT_TRUE(calibration) << describe(calibration.error());
  EXPECT_LE(calibration->distortion.residual, tolerance);
  const Raster raster = raster_of(constants);
  double worst = 0;
  for (int u = 0; u < 720; u += 8) {
    for (int v = 0; v < 576; v += 8) {
      const Eigen::Vector2d seen(u, v);
      const Eigen::Vector2d on_axis = undistort(lens, to_chip(raster, seen)) + lens.center_shift;
      const Eigen::Vector3d optical(on_axis.x(), -on_axis.y(), lens.image_distance);
      worst = std::max(worst, (opencv_pixel(*calibration, optical) - seen).norm());
    }
  }
  EXPECT_LE(worst, calibration->distortion.residual + 1e-6);
}

}  // namespace trk_bridge::camera::opencv_test
