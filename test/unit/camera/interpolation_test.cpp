// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/interpolation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera::interpolation_test {

constexpr double degree = 3.14159265358979323846 / 180;

wire::CameraParams record(std::uint32_t format, double fov) {
  wire::CameraParams params;
  params.format = wire::euler | format;
  params.fov = fov;
  return params;
}

wire::CameraParams halfway(const wire::CameraParams& a, const wire::CameraParams& b, double part = 0.5) {
  const auto from = decode_relative(a).value(), to = decode_relative(b).value();
  Camera between;
  between.pose.translation() = interpolate(from.pose.translation().eval(), to.pose.translation().eval(), part);
  between.pose.linear() = interpolate(from.pose.linear().eval(), to.pose.linear().eval(), part);
  between.lens = interpolate(from.lens, to.lens, part);
  return encode_relative(between, a.format).value();
}

/// Chip 10 mm wide: 90 degrees are 5 mm, and 2 atan(10 / 30) = 36.8699 degrees are 15 mm. Halfway, 10 mm are 2
/// atan(1/2) = 53.1301 degrees.
TEST(Interpolation, AnAngleOfViewIsLinearInFocalLengthWithoutConstants) {
  for (const std::uint32_t format : {std::uint32_t{wire::field_of_view}, wire::field_of_view | wire::vertical,
                                     wire::field_of_view | wire::diagonal | wire::ignore_blank | wire::keep_aspect}) {
    EXPECT_NEAR(halfway(record(format, 90), record(format, 36.86989764584402)).fov, 53.13010235415598, 1e-9);
  }
}

TEST(Interpolation, AnImageDistanceAndTheOtherNumbersOfALensAreLinear) {
  auto a = record(wire::shift_in_pixels, 5), b = record(wire::shift_in_pixels, 15);
  a.center_x = -3, b.center_x = 1;
  a.center_y = 2, b.center_y = 4;
  a.k1 = 1e-3, b.k1 = 3e-3;
  a.k2 = 0, b.k2 = 4e-6;
  a.focdist = 2, b.focdist = 6;
  a.aperture = 2.8, b.aperture = 5.6;
  const auto c = halfway(a, b, 0.25);
  EXPECT_NEAR(c.fov, 7.5, 1e-12);
  EXPECT_NEAR(c.center_x, -2, 1e-12);
  EXPECT_NEAR(c.center_y, 2.5, 1e-12);
  EXPECT_NEAR(c.k1, 1.5e-3, 1e-15);
  EXPECT_NEAR(c.k2, 1e-6, 1e-18);
  EXPECT_NEAR(c.focdist, 3, 1e-12);
  EXPECT_NEAR(c.aperture, 3.5, 1e-12);
  EXPECT_EQ(c.format, a.format);
}

TEST(Interpolation, TheShorterWayAcrossTheBack) {
  auto a = record(0, 10), b = record(0, 10);
  a.euler.pan = -179;
  b.euler.pan = 179;
  EXPECT_NEAR(std::remainder(halfway(a, b).euler.pan - 180, 360), 0, 1e-9);
  EXPECT_NEAR(std::remainder(halfway(a, b, 0.25).euler.pan + 179.5, 360), 0, 1e-9);
}

/// A camera that tilts over the top: at 80 degrees, and 20 degrees further, which is tilt 80 with pan and roll 180.
TEST(Interpolation, OverTheTopTheAxisGoesStraight) {
  auto a = record(0, 10), b = record(0, 10);
  a.euler.tilt = 80;
  b.euler.tilt = 80;
  b.euler.pan = b.euler.roll = 180;
  for (const double part : {0.0, 0.1, 0.45, 0.5, 0.55, 1.0}) {
    const Eigen::Matrix3d rotation = decode_pose(halfway(a, b, part)).value().linear();
    const double angle = (80 + 20 * part) * degree;
    EXPECT_NEAR((rotation.col(1) - Eigen::Vector3d(0, std::cos(angle), std::sin(angle))).norm(), 0, 1e-9) << part;
    EXPECT_NEAR((rotation.col(0) - Eigen::Vector3d::UnitX()).norm(), 0, 1e-9) << part;
  }
}

TEST(Interpolation, ATurnIsExtrapolatedBeyondTheSamples) {
  auto a = record(0, 10), b = record(0, 10);
  a.euler.pan = 10;
  b.euler.pan = 14;
  b.euler.x = 1;
  EXPECT_NEAR(halfway(a, b, 2.5).euler.pan, 20, 1e-9);
  EXPECT_NEAR(halfway(a, b, 2.5).euler.x, 2.5, 1e-12);
}

/// y-up on both sides, studio to camera: the position is in the inverse matrix.
TEST(Interpolation, MatricesOfAnyAxesMoveTheCameraAndNotTheStudio) {
  Camera from, to;
  from.lens.image_distance = to.lens.image_distance = 10;
  from.pose.linear() = rotation_of({0, 0, 0});
  to.pose.linear() = rotation_of({90, 0, 0});
  from.pose.translation() << 4, 0, 0;
  to.pose.translation() << 6, 2, 0;
  const std::uint32_t format = wire::studio_to_camera | wire::camera_y_up | wire::studio_y_up;
  const auto middle =
      decode_pose(halfway(encode(from, format, nullptr).value(), encode(to, format, nullptr).value())).value();
  EXPECT_NEAR((middle.translation() - Eigen::Vector3d(5, 1, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(pan_tilt_roll(middle.linear()).pan, 45, 1e-9);
}

TEST(Interpolation, InvalidCamerasAreRefused) {
  EXPECT_EQ(decode_relative(record(wire::field_of_view, 180)).error(), CameraReason::bad_field_of_view);
  EXPECT_EQ(decode_relative(record(0, -1)).error(), CameraReason::bad_field_of_view);
  EXPECT_EQ(decode_relative(record(0x8000, 10)).error(), CameraReason::bad_format);
  auto bad = record(0, 10);
  bad.euler.pan = std::nan("");
  EXPECT_EQ(decode_relative(bad).error(), CameraReason::not_finite);
}

}  // namespace trk_bridge::camera::interpolation_test
