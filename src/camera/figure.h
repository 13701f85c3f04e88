// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The geometry that is drawn for a camera: the border of its image at depths in front of it. All points are in the
// optical frame (REP 103: x right, y down, z forward), in metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// The lens of a CameraInfo: K (row-major), D (0, 4, 5 or 8 coefficients, see fit_lens) and the size of the complete
/// image in pixels.
struct ViewingLens {
  std::array<double, 9> k{};
  std::vector<double> d;
  std::uint32_t width = 0, height = 0;
};
/// Whether all numbers are equal.
[[nodiscard]] bool operator==(const ViewingLens&, const ViewingLens&) noexcept;
[[nodiscard]] bool operator!=(const ViewingLens&, const ViewingLens&) noexcept;

/// Points of `bent` per edge of the image.
inline constexpr std::size_t border_points_an_edge = 16;

/// The outer edges of the image, half a pixel beyond the centres of its outermost pixels, projected to depth 1 (z = 1).
/// Multiply by z for depth z.
struct ImageBorder {
  using Corners = std::array<Eigen::Vector3d, 4>;  ///< top left, top right, bottom right, bottom left of the image

  /// The border with the distortion of the lens: clockwise from the top left corner, not closed (the last point is not
  /// the first), border_points_an_edge points per edge, evenly spaced in pixels. Corners are at multiples of that
  /// number.
  std::array<Eigen::Vector3d, 4 * border_points_an_edge> bent;
  Corners corners;   ///< of the bent border
  Corners straight;  ///< of the image of a pinhole camera with the same K

  /// Angles in degrees of the bent border: between the rays through the centres of opposite edges, and through the
  /// first and third corner.
  double horizontal = 0, vertical = 0, diagonal = 0;
};

/// The largest angle from the optical axis that is drawn, degrees: beyond it, the border is far away at any depth.
inline constexpr double widest_drawn_angle = 89;

/// The largest distance (m) at which a focus plane is drawn: lenses send many different numbers for "infinity".
inline constexpr double farthest_focus = 1000;

/// Whether a focus plane at `focdist` (m) is drawn: more than 0, at most farthest_focus.
[[nodiscard]] constexpr bool draws_focus(double focdist) noexcept { return focdist > 0 && focdist <= farthest_focus; }

/// Exact also for D with tangential terms. Takes some microseconds, and less than a millisecond for lenses that nearly
/// fold: reuse the result while the lens does not change. Allocates nothing. Errors: bad_calibration (an impossible K,
/// a wrong number of coefficients, an image without pixels or without extent), not_monotonic (D folds within the
/// image), too_wide (the border, bent or straight, is farther from the axis than widest_drawn_angle).
[[nodiscard]] Result<ImageBorder> image_border(const ViewingLens&) noexcept;

/// Line segments as pairs of points: the border at depths `near` and `far` (0 < near < far) and the four edges between
/// their corners.
[[nodiscard]] std::vector<Eigen::Vector3d> frustum_lines(const ImageBorder&, double near, double far);

/// The border at `depth`, closed (the last point is the first).
[[nodiscard]] std::vector<Eigen::Vector3d> outline_at(const ImageBorder&, double depth);

/// Triangles of three points each: the area inside the border at `depth`, without overlap; both sides are visible. All
/// triangles share the point on the optical axis if it is in the image, so that they stay inside a bent border.
[[nodiscard]] std::vector<Eigen::Vector3d> area_at(const ImageBorder&, double depth);

}  // namespace trk_bridge::camera
