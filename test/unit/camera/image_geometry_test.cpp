// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The published CameraInfo with image_geometry.
#include <gmock/gmock.h>
#include <image_geometry/pinhole_camera_model.h>

#include "trk_bridge/camera/calibration.h"
#include "worked_cases.h"

namespace trk_bridge::camera::image_geometry_test {

constexpr double tolerance = 0.02;

sensor_msgs::CameraInfo camera_info_of(const Calibration& calibration) {
  sensor_msgs::CameraInfo info;
  info.width = calibration.width;
  info.height = calibration.height;
  info.distortion_model = name(calibration.distortion.model);
  const auto& d = calibration.distortion;
  info.D.assign(d.d.begin(), d.d.begin() + (d.model == DistortionModel::plumb_bob ? 5 : 8));
  std::copy(calibration.k.begin(), calibration.k.end(), info.K.begin());
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto& k = calibration.k;
  info.P = {k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0};
  return info;
}

TEST(PinholeCameraModel, PutsThePointsOfTheWorkedCasesWhereTheCameraSeesThem) {
  for (const auto& c : test::worked_cases()) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto camera = decode(c.params, &c.constants);
    ASSERT_TRUE(camera) << describe(camera.error());
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(camera->lens, c.constants);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    image_geometry::PinholeCameraModel model;
    model.fromCameraInfo(camera_info_of(*calibration));
    for (const auto& point : c.points) {
      const Eigen::Vector3d in_camera = camera->pose.inverse() * point.studio;
      const cv::Point2d pinhole = model.project3dToPixel({in_camera.x(), -in_camera.z(), in_camera.y()});
      EXPECT_LE((Eigen::Vector2d(pinhole.x, pinhole.y) - point.pinhole).norm(), 1e-6);
      const cv::Point2d seen = model.unrectifyPoint(pinhole);
      EXPECT_LE((Eigen::Vector2d(seen.x, seen.y) - point.distorted).norm(), tolerance);
    }
  }
}

}  // namespace trk_bridge::camera::image_geometry_test
