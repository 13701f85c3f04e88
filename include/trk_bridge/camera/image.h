// Chip, pixels and lens: projection, rasterisation, distortion (doc/conventions.md, "Chip, blanks and pixels" to
// "Distortion").
#pragma once

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Pixels per millimetre and the pixel of the chip's centre, from the lower left corner of the image, y up.
struct Raster {
  double mx = 0, my = 0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double width = 0, height = 0;  ///< of the image, pixels
};
/// Constants must have passed check().
[[nodiscard]] Raster raster_of(const wire::CameraConstants&) noexcept;

/// The angle (degrees) that a side of the chip (mm) takes up at an image distance (mm), without distortion and centre
/// shift. not_finite for such a distance; bad_field_of_view unless both are more than 0 and the angle lies between 0
/// and 180 degrees.
[[nodiscard]] Result<double> field_of_view(double image_distance, double side) noexcept;

/// A point in the camera frame (m; x right, y forward, z up) to the undistorted chip (mm, from the chip's centre).
/// behind_camera unless y > 0.
[[nodiscard]] Result<Eigen::Vector2d> project(const Lens&, const Eigen::Vector3d& point) noexcept;

/// Chip positions in mm from the chip's centre; the polynomial is about the optical axis.
[[nodiscard]] Eigen::Vector2d undistort(const Lens&, const Eigen::Vector2d& distorted) noexcept;
/// The inverse, by Newton on the radius to the last digits; not_monotonic where the polynomial folds before it gets
/// there.
[[nodiscard]] Result<Eigen::Vector2d> distort(const Lens&, const Eigen::Vector2d& undistorted) noexcept;

/// The largest distorted radius (mm about the optical axis) up to which the polynomial is monotonic; infinite where it
/// never folds.
[[nodiscard]] double monotonic_radius(const Lens&) noexcept;

/// The farthest that the image, blanks and all, reaches from the optical axis on the chip (mm, distorted).
[[nodiscard]] double image_reach(const Lens&, const Raster&) noexcept;

/// Chip (mm) <-> pixel in ROS coordinates: origin in the centre of the top left pixel, y down.
[[nodiscard]] Eigen::Vector2d to_pixel(const Raster&, const Eigen::Vector2d& chip) noexcept;
/// The way back: pixel to mm from the chip's centre, y up.
[[nodiscard]] Eigen::Vector2d to_chip(const Raster&, const Eigen::Vector2d& pixel) noexcept;

}  // namespace trk_bridge::camera
