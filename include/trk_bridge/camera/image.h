// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Chip, pixels and lens: projection, pixel grid, distortion (doc/conventions.md, "Chip, blanks and pixels" to
// "Distortion").
#pragma once

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Pixels per millimetre, and the centre of the chip in pixels from the lower left corner of the image, y up.
struct Raster {
  double mx = 0, my = 0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double width = 0, height = 0;  ///< of the image, pixels
};
/// Constants must have passed check().
[[nodiscard]] Raster raster_of(const wire::CameraConstants&) noexcept;

/// The angle (degrees) of a side of the chip (mm) at an image distance (mm), without distortion and centre shift.
/// not_finite if the distance is not finite; bad_field_of_view unless both are more than 0 and the angle is between 0
/// and 180 degrees.
[[nodiscard]] Result<double> field_of_view(double image_distance, double side) noexcept;

/// Projects a point in the camera frame (m; x right, y forward, z up) to the undistorted chip (mm from its centre).
/// behind_camera unless y > 0.
[[nodiscard]] Result<Eigen::Vector2d> project(const Lens&, const Eigen::Vector3d& point) noexcept;

/// Chip positions in mm from the centre of the chip; the polynomial is centred on the optical axis.
[[nodiscard]] Eigen::Vector2d undistort(const Lens&, const Eigen::Vector2d& distorted) noexcept;
/// The inverse, by Newton's method on the radius to full precision; not_monotonic if the polynomial folds before it
/// reaches the radius.
[[nodiscard]] Result<Eigen::Vector2d> distort(const Lens&, const Eigen::Vector2d& undistorted) noexcept;

/// The largest distorted radius (mm from the optical axis) up to which the polynomial is monotonic; infinite if it
/// never folds.
[[nodiscard]] double monotonic_radius(const Lens&) noexcept;

/// The largest distance of the image, including its blanks, from the optical axis on the chip (mm, distorted).
[[nodiscard]] double image_reach(const Lens&, const Raster&) noexcept;

/// From the chip (mm) to a pixel in ROS coordinates: origin in the centre of the top left pixel, y down.
[[nodiscard]] Eigen::Vector2d to_pixel(const Raster&, const Eigen::Vector2d& chip) noexcept;
/// The inverse: from a pixel to mm from the centre of the chip, y up.
[[nodiscard]] Eigen::Vector2d to_chip(const Raster&, const Eigen::Vector2d& pixel) noexcept;

}  // namespace trk_bridge::camera
