// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Whether two cameras or two angles are equal, after a conversion that may lose digits or, with CameraInfo, a little of
// the lens.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::test {

/// The absolute difference, modulo 360 degrees.
inline double degrees_apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

/// To 1e-9, relative beyond 1.
inline ::testing::AssertionResult same_to_the_digits(const camera::Camera& camera, const camera::Camera& wanted) {
  const auto off = [](double value, double target) {
    return !(std::abs(value - target) <= 1e-9 * (1 + std::abs(target)));
  };
  for (int i = 0; i < 16; ++i) {
    if (off(camera.pose.matrix().data()[i], wanted.pose.matrix().data()[i])) {
      return ::testing::AssertionFailure() << "pose\n" << camera.pose.matrix() << "\nis not\n" << wanted.pose.matrix();
    }
  }
  const auto& lens = camera.lens;
  const auto& target = wanted.lens;
  if (off(lens.image_distance, target.image_distance) || off(lens.center_shift.x(), target.center_shift.x()) ||
      off(lens.center_shift.y(), target.center_shift.y()) || lens.k1 != target.k1 || lens.k2 != target.k2 ||
      lens.focdist != target.focdist || lens.aperture != target.aperture) {
    return ::testing::AssertionFailure() << "lens " << lens.image_distance << " mm, shift "
                                         << lens.center_shift.transpose() << " is not " << target.image_distance
                                         << " mm, " << target.center_shift.transpose()
                                         << ", or k1, k2, focus, aperture";
  }
  return ::testing::AssertionSuccess();
}

/// The largest displacement of a pixel of a grid over the image; infinite if one cannot be projected.
inline double worst_pixel(const camera::Lens& lens, const camera::Lens& wanted,
                          const wire::CameraConstants& constants) {
  constexpr int steps = 8;
  const auto raster = camera::raster_of(constants);
  double worst = 0;
  for (int row = 0; row <= steps; ++row) {
    for (int column = 0; column <= steps; ++column) {
      const Eigen::Vector2d pixel(raster.width * column / steps - 0.5, raster.height * row / steps - 0.5);
      const Eigen::Vector2d pinhole = camera::undistort(wanted, camera::to_chip(raster, pixel));
      const Eigen::Vector2d ray = (pinhole + wanted.center_shift) / wanted.image_distance;
      const auto chip = camera::distort(lens, ray * lens.image_distance - lens.center_shift);
      if (!chip) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, (camera::to_pixel(raster, *chip) - pixel).norm());
    }
  }
  return worst;
}

/// To 1e-6 m, 1e-6 rad and 0.02 pixel. Focus and aperture do not count.
inline ::testing::AssertionResult same_to_the_eye(const camera::Camera& camera, const camera::Camera& wanted,
                                                  const wire::CameraConstants& constants) {
  const double metres = (camera.pose.translation() - wanted.pose.translation()).norm();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(camera.pose.linear().transpose() * wanted.pose.linear()));
  const double pixels = worst_pixel(camera.lens, wanted.lens, constants);
  if (metres < 1e-6 && std::abs(turn.angle()) < 1e-6 && pixels < 0.02) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "off by " << metres << " m, " << turn.angle() << " rad, " << pixels << " px";
}

}  // namespace trk_bridge::test
