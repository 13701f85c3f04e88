// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric.h"

namespace trk_bridge::camera {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Undistorted radius over distorted radius.
double radial_factor(const Lens& lens, double squared_radius) noexcept {
  return 1 + squared_radius * (lens.k1 + squared_radius * lens.k2);
}

}  // namespace

Raster raster_of(const wire::CameraConstants& c) noexcept {
  Raster raster;
  raster.width = c.image_width;
  raster.height = c.image_height;
  const double picture_width = raster.width - c.blank_left - c.blank_right;
  const double picture_height = raster.height - c.blank_top - c.blank_bottom;
  raster.mx = picture_width / c.chip_width;
  raster.my = picture_height / c.chip_height;
  raster.center = {c.blank_left + picture_width / 2, c.blank_bottom + picture_height / 2};
  return raster;
}

Result<double> field_of_view(double image_distance, double side) noexcept {
  if (!std::isfinite(image_distance)) return tl::unexpected(CameraReason::not_finite);
  if (!(image_distance > 0) || !(side > 0)) return tl::unexpected(CameraReason::bad_field_of_view);
  const double angle = 2 * std::atan2(side / 2, image_distance) * degrees_per_radian;
  // An unrealistic image distance can round to 0 or 180 degrees, which could not be read back.
  if (!(angle > 0 && angle < 180)) return tl::unexpected(CameraReason::bad_field_of_view);
  return angle;
}

Result<Eigen::Vector2d> project(const Lens& lens, const Eigen::Vector3d& point) noexcept {
  if (!(point.y() > 0)) return tl::unexpected(CameraReason::behind_camera);
  const Eigen::Vector2d chip =
      lens.image_distance * Eigen::Vector2d(point.x() / point.y(), point.z() / point.y()) - lens.center_shift;
  if (!chip.allFinite()) return tl::unexpected(CameraReason::not_finite);
  return chip;
}

Eigen::Vector2d undistort(const Lens& lens, const Eigen::Vector2d& distorted) noexcept {
  const Eigen::Vector2d from_axis = distorted + lens.center_shift;
  return radial_factor(lens, from_axis.squaredNorm()) * from_axis - lens.center_shift;
}

double monotonic_radius(const Lens& lens) noexcept {
  // The slope is 1 + 3 k1 R + 5 k2 R^2 with R the squared radius. The unit keeps k1 and k2 at 1 or less, so that
  // nothing overflows.
  const double unit = std::max(std::abs(lens.k1), std::sqrt(std::abs(lens.k2)));
  if (!(unit > 0)) return infinity;
  const double b = 3 * (lens.k1 / unit);
  const double a = 5 * (lens.k2 / unit / unit);
  const double discriminant = b * b - 4 * a;
  if (!(discriminant > 0)) return infinity;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
  double smallest = infinity;
  for (const double root : {1 / q, q / a}) {
    if (root > 0) smallest = std::min(smallest, root);
  }
  return std::sqrt(smallest / unit);
}

Result<Eigen::Vector2d> distort(const Lens& lens, const Eigen::Vector2d& undistorted) noexcept {
  const Eigen::Vector2d from_axis = undistorted + lens.center_shift;
  const double wanted = from_axis.stableNorm();
  if (!std::isfinite(wanted) || !std::isfinite(lens.k1) || !std::isfinite(lens.k2)) {
    return tl::unexpected(CameraReason::not_finite);
  }
  if (wanted == 0) return undistorted;
  const auto excess = [&lens, wanted](double radius) {
    const double squared = radius * radius;
    return ValueAndSlope{radius * radial_factor(lens, squared) - wanted,
                         1 + squared * (3 * lens.k1 + 5 * squared * lens.k2)};
  };
  const double limit = monotonic_radius(lens);
  // Without a fold, the polynomial is always at least 4/9 of the radius: its factor is smallest where 9 k1^2 = 20 k2.
  const double high = std::isfinite(limit) ? limit : 2.25 * wanted;
  if (excess(high).value < 0) return tl::unexpected(CameraReason::not_monotonic);
  const double radius = increasing_root(excess, 0, high, std::min(wanted, high));
  const Eigen::Vector2d distorted = radius / wanted * from_axis - lens.center_shift;
  if (!distorted.allFinite()) return tl::unexpected(CameraReason::not_finite);
  return distorted;
}

double image_reach(const Lens& lens, const Raster& raster) noexcept {
  double reach = 0;
  for (const double u : {-0.5, raster.width - 0.5}) {
    for (const double v : {-0.5, raster.height - 0.5}) {
      reach = std::max(reach, (to_chip(raster, {u, v}) + lens.center_shift).norm());
    }
  }
  return reach;
}

Eigen::Vector2d to_pixel(const Raster& raster, const Eigen::Vector2d& chip) noexcept {
  return {raster.mx * chip.x() + raster.center.x() - 0.5,
          raster.height - (raster.my * chip.y() + raster.center.y()) - 0.5};
}

Eigen::Vector2d to_chip(const Raster& raster, const Eigen::Vector2d& pixel) noexcept {
  return {(pixel.x() + 0.5 - raster.center.x()) / raster.mx,
          (raster.height - pixel.y() - 0.5 - raster.center.y()) / raster.my};
}

}  // namespace trk_bridge::camera
