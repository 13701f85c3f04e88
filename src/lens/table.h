// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Lens tables: the lens as a function of its encoder counts (doc/free_d.md, "Lens tables").
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::lens {

/// Positions of the encoders, in counts.
struct Position {
  double zoom = 0, focus = 0;
};

/// Interpolation between points over zoom. Over focus it is linear.
enum class Interpolation : std::uint8_t {
  pchip,  ///< piecewise cubic, without overshoot (Fritsch and Carlson)
  linear,
};

/// One row of `points`: the lens at one position.
struct Point {
  Position at;
  camera::Lens lens;  ///< without focdist and aperture
};

/// One row of `focus`.
struct FocusPoint {
  double count = 0;
  double distance = 0;  ///< m
};

/// The content of a table file.
struct Points {
  Interpolation interpolation = Interpolation::pchip;
  std::vector<Point> points;
  std::vector<FocusPoint> focus;                   ///< may be empty: focus distances are unknown
  std::optional<wire::CameraConstants> constants;  ///< of the camera with which the lens was measured
};

/// Immutable: may be used from any thread. Only the functions that create a table allocate.
///
/// A position outside of the table by at most 1 % of its range is treated as the nearest end, because encoders have
/// some play at their stops. There is no extrapolation beyond that.
class Table {
 public:
  /// Parses a table. The error begins with `file_name` and the line (`lens.yaml:12: …`).
  static tl::expected<Table, std::string> from_yaml(const std::string& yaml, const std::string& file_name);
  /// The same from a file. The error names the path.
  static tl::expected<std::shared_ptr<const Table>, std::string> load(const std::string& path);

  /// The lens at a position; aperture is 0, and focdist is 0 if the table has no focus distances. None outside of the
  /// table.
  [[nodiscard]] std::optional<camera::Lens> lens_at(const Position&) const noexcept;
  /// The inverse from image distance and focdist, to a quarter of a count. A focdist of 0 ("not given" in trk) is
  /// treated as the largest distance. None outside of the table.
  [[nodiscard]] std::optional<Position> position_of(const camera::Lens&) const noexcept;

  /// The first and the last position.
  Position first() const noexcept { return {zooms_.front(), focus_range().first}; }
  Position last() const noexcept { return {zooms_.back(), focus_range().second}; }
  bool has_focus() const noexcept { return focuses_.size() > 1 || !distances_.empty(); }
  bool has_distances() const noexcept { return !distances_.empty(); }
  const Points& points() const noexcept { return points_; }
  const std::optional<wire::CameraConstants>& constants() const noexcept { return points_.constants; }

 private:
  /// The values interpolated over zoom: image distance, centre shift x and y, k1, k2.
  using Values = Eigen::Array<double, 5, 1>;
  struct Knot {
    Values value, slope;  // slope: per count of zoom
  };

  Table() = default;
  void prepare(Points points);
  std::pair<double, double> focus_range() const noexcept;
  Values slice_at(std::size_t focus, double zoom) const noexcept;
  Values values_at(const Position&) const noexcept;

  Points points_;
  std::vector<double> zooms_, focuses_;  // ascending; one focus if the table does not depend on focus
  std::vector<Knot> knots_;              // zooms_.size() for each of focuses_
  std::vector<FocusPoint> distances_;    // by count
};

}  // namespace trk_bridge::lens
