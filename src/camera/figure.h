// What is drawn of a camera: where the borders of its image lie in front of it. All points are in the optical frame
// (REP 103: x right, y down, z forward), metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// A CameraInfo's lens: K row after row, D (0, 4, 5 or 8 coefficients, see fit_lens) and the size of the whole image in
/// pixels.
struct ViewingLens {
  std::array<double, 9> k{};
  std::vector<double> d;
  std::uint32_t width = 0, height = 0;
};
/// Whether both have the same border, number by number.
[[nodiscard]] bool operator==(const ViewingLens&, const ViewingLens&) noexcept;
[[nodiscard]] bool operator!=(const ViewingLens&, const ViewingLens&) noexcept;

/// Points of `bent` an edge of the image.
inline constexpr std::size_t border_points_an_edge = 16;

/// The image's outer edges, half a pixel beyond the centres of its outermost pixels, looked through to depth 1 (z = 1).
/// Scaled by z they lie at depth z.
struct ImageBorder {
  using Corners = std::array<Eigen::Vector3d, 4>;  ///< top left, top right, bottom right, bottom left of the image

  /// As the lens bends it: open (the last is not the first), from the top left corner clockwise, border_points_an_edge
  /// an edge, evenly over its pixels. Corners are at multiples of that.
  std::array<Eigen::Vector3d, 4 * border_points_an_edge> bent;
  Corners corners;   ///< of the bent border
  Corners straight;  ///< of a pinhole's image with the same K

  /// Angles in degrees between the rays through the middles of opposite edges, and through the first and third corner,
  /// all of the bent border.
  double horizontal = 0, vertical = 0, diagonal = 0;
};

/// The widest angle off the optical axis that is drawn, degrees: beyond it a border at any depth is far away.
inline constexpr double widest_drawn_angle = 89;

/// Farther off than this (m) a plane in focus is not drawn: lenses give "infinity" as many different numbers.
inline constexpr double farthest_focus = 1000;

/// Whether a plane in focus at `focdist` (m) is drawn: more than 0, at most farthest_focus.
[[nodiscard]] constexpr bool draws_focus(double focdist) noexcept { return focdist > 0 && focdist <= farthest_focus; }

/// Exact for D with tangential terms, too. Takes some microseconds, a fraction of a millisecond for lenses that are
/// nearly folded: keep the result while the lens stays. Allocates nothing. Errors: bad_calibration (K that no camera
/// has, another number of coefficients, an image without pixels or of no extent), not_monotonic (D folds within the
/// image), too_wide (the border, bent or straight, is farther off the axis than widest_drawn_angle).
[[nodiscard]] Result<ImageBorder> image_border(const ViewingLens&) noexcept;

/// Pairs of points, a line segment each: the border at depths `near` and `far` (0 < near < far) and the four edges that
/// join their corners.
[[nodiscard]] std::vector<Eigen::Vector3d> frustum_lines(const ImageBorder&, double near, double far);

/// The border at `depth`, closed (the last point is the first).
[[nodiscard]] std::vector<Eigen::Vector3d> outline_at(const ImageBorder&, double depth);

/// Three points a triangle: the area within the border at `depth`, to be filled without overlap; both sides count. The
/// triangles share the optical axis where it is in the image, so that they stay inside however the lens bends it.
[[nodiscard]] std::vector<Eigen::Vector3d> area_at(const ImageBorder&, double depth);

}  // namespace trk_bridge::camera
