// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The worked cases, in both directions.
#include <gmock/gmock.h>

#include <cmath>

#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/format.h"
#include "worked_cases.h"

namespace trk_bridge::camera::cases_test {

constexpr double tolerance = 1e-9;

void expect_near(double actual, double expected, const std::string& what) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << actual << " instead of " << expected;
}

void expect_angle(double actual, double expected, const std::string& what) {
  EXPECT_LE(std::abs(std::remainder(actual - expected, 360.0)), tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << actual << " instead of " << expected;
}

template <typename A, typename B>
void expect_all_near(const A& actual, const B& expected, const std::string& what) {
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    expect_near(actual(i), expected(i), what + " element " + std::to_string(i));
  }
}

class WorkedCases : public ::testing::Test {
 protected:
  const std::vector<test::WorkedCase> cases = test::worked_cases();
};

TEST_F(WorkedCases, AreAllThere) { EXPECT_EQ(cases.size(), 256U); }

TEST_F(WorkedCases, DecodeToTheExpectedCamera) {
  for (const auto& c : cases) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto camera = decode(c.params, &c.constants);
    ASSERT_TRUE(camera) << describe(camera.error());
    expect_all_near(camera->pose.matrix().reshaped(), c.camera.pose.matrix().reshaped(), "pose");
    const PanTiltRoll angles = pan_tilt_roll(camera->pose.linear());
    expect_angle(angles.pan, c.angles.pan, "pan");
    expect_angle(angles.tilt, c.angles.tilt, "tilt");
    expect_angle(angles.roll, c.angles.roll, "roll");
    expect_near(camera->lens.image_distance, c.camera.lens.image_distance, "image distance");
    expect_all_near(camera->lens.center_shift, c.camera.lens.center_shift, "centre shift");
    EXPECT_EQ(camera->lens.k1, c.params.k1);
    EXPECT_EQ(camera->lens.k2, c.params.k2);
    EXPECT_EQ(camera->lens.focdist, c.params.focdist);
    EXPECT_EQ(camera->lens.aperture, c.params.aperture);
  }
}

TEST_F(WorkedCases, EncodeToTheParametersOfTheSender) {
  for (const auto& c : cases) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto params = encode(c.camera, c.mask, &c.constants);
    ASSERT_TRUE(params) << describe(params.error());
    EXPECT_EQ(params->format, c.mask);
    if (wire::has(c.mask, wire::euler)) {
      expect_near(params->euler.x, c.params.euler.x, "x");
      expect_near(params->euler.y, c.params.euler.y, "y");
      expect_near(params->euler.z, c.params.euler.z, "z");
      expect_angle(params->euler.pan, c.params.euler.pan, "pan");
      expect_angle(params->euler.tilt, c.params.euler.tilt, "tilt");
      expect_angle(params->euler.roll, c.params.euler.roll, "roll");
    } else {
      for (std::size_t i = 0; i < 16; ++i) {
        expect_near(params->matrix[i], c.params.matrix[i], "matrix element " + std::to_string(i));
      }
    }
    expect_near(params->fov, c.params.fov, "fov");
    expect_near(params->center_x, c.params.center_x, "centerX");
    expect_near(params->center_y, c.params.center_y, "centerY");
    EXPECT_EQ(params->k1, c.params.k1);
    EXPECT_EQ(params->k2, c.params.k2);
    EXPECT_EQ(params->focdist, c.params.focdist);
    EXPECT_EQ(params->aperture, c.params.aperture);
  }
}

TEST_F(WorkedCases, ShowTheirPointsAtTheirPixels) {
  for (const auto& c : cases) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto camera = decode(c.params, &c.constants);
    ASSERT_TRUE(camera) << describe(camera.error());
    const Raster raster = raster_of(c.constants);
    for (const auto& point : c.points) {
      const Eigen::Vector3d in_camera = camera->pose.inverse() * point.studio;
      expect_all_near(in_camera, point.camera, "camera coordinates");
      const auto pinhole = project(camera->lens, in_camera);
      ASSERT_TRUE(pinhole) << describe(pinhole.error());
      expect_all_near(to_pixel(raster, *pinhole), point.pinhole, "undistorted pixel");
      const auto distorted = distort(camera->lens, *pinhole);
      ASSERT_TRUE(distorted) << describe(distorted.error());
      expect_all_near(to_pixel(raster, *distorted), point.distorted, "distorted pixel");
      expect_all_near(to_pixel(raster, undistort(camera->lens, to_chip(raster, point.distorted))), point.pinhole,
                      "undistorted again");
    }
  }
}

TEST_F(WorkedCases, HaveTheExpectedCameraMatrix) {
  for (const auto& c : cases) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    const auto lens = decode_lens(c.params, &c.constants);
    ASSERT_TRUE(lens) << describe(lens.error());
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(*lens, c.constants);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    for (std::size_t i = 0; i < 9; ++i) expect_near(calibration->k[i], c.k[i], "K element " + std::to_string(i));
    EXPECT_EQ(static_cast<std::int32_t>(calibration->width), c.constants.image_width);
    EXPECT_EQ(static_cast<std::int32_t>(calibration->height), c.constants.image_height);
  }
}

}  // namespace trk_bridge::camera::cases_test
