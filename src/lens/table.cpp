// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <utility>

#include "base/number_text.h"
#include "base/yaml_text.h"
#include "trk_bridge/camera/image.h"
#include "trk_bridge/wire/format.h"
#include "wire/number.h"

namespace trk_bridge::lens {
namespace {

using base::general_text;
using base::YamlFault;
using base::YamlValue;

template <typename T>
using Read = base::YamlRead<T>;

constexpr double play = 0.01;        // of the range, at each end
constexpr double count_step = 0.25;  // for the inverse

// Limits of the numbers in a table: results do not overflow, and a double resolves counts more finely than count_step.
constexpr double largest = 1e9;
constexpr double smallest = 1 / largest;  // of numbers that must be more than 0
constexpr double least_step = 1e-3;       // from one zoom to the next

tl::unexpected<YamlFault> fault(const YAML::Mark& mark, std::string what) {
  return tl::unexpected(YamlFault{mark, std::move(what)});
}

Read<double> number_of(const YamlValue& value) {
  double number = 0;
  // yaml-cpp would read it in the program's locale.
  if (!value.node.IsScalar() || wire::read_number(value.node.Scalar(), number)) {
    return fault(value.mark, value.key + ": must be a number");
  }
  if (std::abs(number) > largest) {
    return fault(value.mark, value.key + ": the magnitude must not be more than " + general_text(largest) + ", is " +
                                 general_text(number));
  }
  return number;
}

Read<double> number_or(const YAML::Node& map, const std::string& key, double otherwise) {
  const auto value = base::yaml_value(map, key);
  if (!value.node.IsDefined()) return otherwise;
  return number_of(value);
}

Read<double> positive(const YAML::Node& map, const std::string& key) {
  const auto value = base::yaml_value(map, key);
  auto number = number_of(value);
  if (number && *number <= 0) return fault(value.mark, key + ": must be more than 0, is " + general_text(*number));
  if (number && *number < smallest) {
    return fault(value.mark, key + ": must be at least " + general_text(smallest) + ", is " + general_text(*number));
  }
  return number;
}

Read<wire::CameraConstants> constants_of(const YamlValue& value) {
  if (!value.node.IsMap()) return fault(value.mark, "constants: must be a map of image and chip");
  const auto keys = base::check_yaml_keys(value.node, {"image_width", "image_height", "chip_width", "chip_height"},
                                          {"blank_left", "blank_right", "blank_top", "blank_bottom"});
  if (!keys) return tl::unexpected(keys.error());
  wire::CameraConstants constants;
  const std::pair<const char*, std::int32_t*> pixels[] = {
      {"image_width", &constants.image_width}, {"image_height", &constants.image_height},
      {"blank_left", &constants.blank_left},   {"blank_right", &constants.blank_right},
      {"blank_top", &constants.blank_top},     {"blank_bottom", &constants.blank_bottom}};
  for (const auto& [key, to] : pixels) {
    const auto number = number_or(value.node, key, 0);
    if (!number) return tl::unexpected(number.error());
    if (*number < 0 || *number > 100000 || *number != std::floor(*number)) {
      return fault(base::yaml_value(value.node, key).mark,
                   std::string(key) + ": must be whole pixels from 0 to 100000, is " + general_text(*number));
    }
    *to = static_cast<std::int32_t>(*number);
  }
  for (const auto& [key, to] :
       {std::pair{"chip_width", &constants.chip_width}, {"chip_height", &constants.chip_height}}) {
    const auto number = positive(value.node, key);
    if (!number) return tl::unexpected(number.error());
    *to = *number;
  }
  if (const auto checked = camera::check(constants); !checked) {
    return fault(value.mark, "constants: " + camera::describe(checked.error()));
  }
  return camera::constants_for(constants, wire::euler);
}

/// From a focal length, or from an angle of view over the chip width.
Read<double> image_distance_of(const YAML::Node& row, const std::optional<wire::CameraConstants>& constants) {
  const auto angle = base::yaml_value(row, "field_of_view");
  const bool has_focal_length = base::yaml_value(row, "focal_length").node.IsDefined();
  if (has_focal_length == angle.node.IsDefined()) {
    return fault(row.Mark(), "either focal_length (mm) or field_of_view (degrees) must be given");
  }
  if (has_focal_length) return positive(row, "focal_length");
  auto degrees = positive(row, "field_of_view");
  if (!degrees) return degrees;
  if (*degrees >= 180) {
    return fault(angle.mark,
                 "field_of_view: must be more than 0 and less than 180 degrees, is " + general_text(*degrees));
  }
  if (!constants) return fault(angle.mark, "field_of_view: needs constants with the chip width");
  return constants->chip_width / 2 / std::tan(*degrees * M_PI / 360);
}

Read<Point> point_of(const YAML::Node& row, const std::optional<wire::CameraConstants>& constants, bool has_focus) {
  if (!row.IsMap()) return fault(row.Mark(), "a point must be a map of zoom, focal_length and others");
  const auto keys = base::check_yaml_keys(
      row, {"zoom"}, {"focus", "focal_length", "field_of_view", "center_x", "center_y", "k1", "k2"});
  if (!keys) return tl::unexpected(keys.error());
  if (base::yaml_value(row, "focus").node.IsDefined() != has_focus) {
    return fault(row.Mark(), "focus: must be given in every point or in none");
  }
  Point point;
  const auto distance = image_distance_of(row, constants);
  if (!distance) return tl::unexpected(distance.error());
  point.lens.image_distance = *distance;
  const std::pair<const char*, double*> numbers[] = {
      {"zoom", &point.at.zoom}, {"focus", &point.at.focus}, {"center_x", &point.lens.center_shift.x()},
      {"k1", &point.lens.k1},   {"k2", &point.lens.k2},     {"center_y", &point.lens.center_shift.y()}};
  for (const auto& [key, to] : numbers) {
    const auto number = number_or(row, key, 0);
    if (!number) return tl::unexpected(number.error());
    *to = *number;
  }
  if (constants) {
    const double reach = camera::image_reach(point.lens, camera::raster_of(*constants));
    if (!(camera::monotonic_radius(point.lens) >= reach)) {
      return fault(row.Mark(), "k1, k2 fold the image within its " + general_text(reach) + " mm from the optical axis");
    }
  }
  return point;
}

/// Whether the step from `from` to `to` has the direction `sign`, which the first step sets.
bool is_monotonic_step(double from, double to, int& sign) {
  const int step = to > from ? 1 : to < from ? -1 : 0;
  if (sign == 0) sign = step;
  return step != 0 && step == sign;
}

Read<std::vector<Point>> points_of(const YamlValue& rows, const std::optional<wire::CameraConstants>& constants) {
  if (!rows.node.IsSequence() || rows.node.size() < 2) return fault(rows.mark, "points: must be a list of two or more");
  const bool has_focus = rows.node[0].IsMap() && base::yaml_value(rows.node[0], "focus").node.IsDefined();
  std::vector<Point> points;
  int sign = 0;
  std::size_t zooms = 0;  // number of zooms of the first focus
  for (const auto& row : rows.node) {
    const auto point = point_of(row, constants, has_focus);
    if (!point) return tl::unexpected(point.error());
    const bool begins_focus = points.empty() || point->at.focus != points.back().at.focus;
    if (begins_focus && !points.empty()) {
      if (zooms == 0) zooms = points.size();
      if (points.size() % zooms != 0) return fault(row.Mark(), "every focus must have the same zooms as the first");
      if (point->at.focus < points.back().at.focus) return fault(row.Mark(), "focus must rise from group to group");
    }
    if (zooms != 0 && (points.size() % zooms == 0) != begins_focus) {
      return fault(row.Mark(), "every focus must have the same zooms as the first");
    }
    if (zooms != 0 && point->at.zoom != points[points.size() % zooms].at.zoom) {
      return fault(row.Mark(),
                   "zoom " + general_text(point->at.zoom) + ": every focus must have the same zooms as the first");
    }
    if (!begins_focus) {
      const Point& before = points.back();
      if (!(point->at.zoom > before.at.zoom)) {
        return fault(row.Mark(), "zoom " + general_text(point->at.zoom) +
                                     ": must be more than that of the row before, " + general_text(before.at.zoom));
      }
      if (point->at.zoom - before.at.zoom < least_step) {
        return fault(row.Mark(), "zoom " + general_text(point->at.zoom) + ": must be at least " +
                                     general_text(least_step) + " more than that of the row before");
      }
      if (!is_monotonic_step(before.lens.image_distance, point->lens.image_distance, sign)) {
        return fault(row.Mark(), "zoom " + general_text(point->at.zoom) +
                                     ": the focal length must rise with zoom, or fall, " + "in all rows alike");
      }
    }
    points.push_back(*point);
  }
  if (zooms != 0 && points.size() % zooms != 0) {
    return fault(rows.mark, "points: every focus must have the same zooms as the first");
  }
  if (points.size() == 1 || zooms == 1) return fault(rows.mark, "points: must have two zooms or more");
  return points;
}

Read<std::vector<FocusPoint>> focus_of(const YamlValue& rows) {
  std::vector<FocusPoint> all;
  if (!rows.node.IsDefined()) return all;
  if (!rows.node.IsSequence() || rows.node.size() < 2) return fault(rows.mark, "focus: must be a list of two or more");
  int sign = 0;
  for (const auto& row : rows.node) {
    if (!row.IsMap()) return fault(row.Mark(), "a point of focus must be a map of count and distance");
    if (const auto keys = base::check_yaml_keys(row, {"count", "distance"}); !keys) return tl::unexpected(keys.error());
    const auto count = number_of(base::yaml_value(row, "count"));
    if (!count) return tl::unexpected(count.error());
    const auto distance = positive(row, "distance");
    if (!distance) return tl::unexpected(distance.error());
    if (!all.empty() && !(*count > all.back().count)) {
      return fault(row.Mark(), "count " + general_text(*count) + ": must be more than that of the row before");
    }
    if (!all.empty() && !is_monotonic_step(all.back().distance, *distance, sign)) {
      return fault(row.Mark(),
                   "distance " + general_text(*distance) + ": must rise with the count, or fall, in all rows alike");
    }
    all.push_back({*count, *distance});
  }
  return all;
}

Read<Interpolation> interpolation_of(const YamlValue& value) {
  const std::string word = !value.node.IsDefined() ? "pchip" : value.node.IsScalar() ? value.node.Scalar() : "";
  if (word == "pchip") return Interpolation::pchip;
  if (word == "linear") return Interpolation::linear;
  return fault(value.mark, "interpolation: must be pchip or linear");
}

Read<Points> table_of(const YAML::Node& root) {
  if (!root.IsMap()) return fault(root.Mark(), "must be a map with points");
  if (const auto keys = base::check_yaml_keys(root, {"points"}, {"focus", "constants", "interpolation"}); !keys) {
    return tl::unexpected(keys.error());
  }
  Points table;
  const auto interpolation = interpolation_of(base::yaml_value(root, "interpolation"));
  if (!interpolation) return tl::unexpected(interpolation.error());
  table.interpolation = *interpolation;
  if (const auto value = base::yaml_value(root, "constants"); value.node.IsDefined()) {
    const auto constants = constants_of(value);
    if (!constants) return tl::unexpected(constants.error());
    table.constants = *constants;
  }
  auto points = points_of(base::yaml_value(root, "points"), table.constants);
  if (!points) return tl::unexpected(points.error());
  table.points = *std::move(points);
  auto focus = focus_of(base::yaml_value(root, "focus"));
  if (!focus) return tl::unexpected(focus.error());
  table.focus = *std::move(focus);
  return table;
}

/// The slope at a knot between two intervals of lengths h and secant slopes d: their weighted harmonic mean, or 0 at an
/// extremum.
double slope_between(double h0, double h1, double d0, double d1) {
  if (!(d0 * d1 > 0)) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// The slope at an end: that of the parabola through three knots, limited so that there is no extremum.
double slope_at_end(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(slope * d0 > 0)) return 0;
  if (!(d0 * d1 > 0) && std::abs(slope) > std::abs(3 * d0)) return 3 * d0;
  return slope;
}

/// Clamps `at` to the range; none if it is outside by more than the play.
std::optional<double> clamped(double at, double first, double last) noexcept {
  const double beyond = play * (last - first);
  if (!(at >= first - beyond && at <= last + beyond)) return std::nullopt;
  return std::clamp(at, first, last);
}

/// The interval of ascending numbers that contains `at`.
template <typename List, typename Key>
std::size_t interval_of(const List& list, double at, const Key& key) noexcept {
  std::size_t low = 0, high = list.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (key(list[middle]) <= at ? low : high) = middle;
  }
  return low;
}
constexpr auto identity = [](double number) { return number; };
constexpr auto count_of = [](const FocusPoint& point) { return point.count; };

}  // namespace

tl::expected<Table, std::string> Table::from_yaml(const std::string& yaml, const std::string& file_name) {
  auto points = base::read_yaml(yaml, file_name, table_of);
  if (!points) return tl::make_unexpected(points.error());
  Table table;
  table.prepare(*std::move(points));
  return table;
}

tl::expected<std::shared_ptr<const Table>, std::string> Table::load(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) return tl::make_unexpected(path + ": cannot be read");
  auto table = from_yaml(text.str(), path);
  if (!table) return tl::make_unexpected(table.error());
  return std::make_shared<const Table>(*std::move(table));
}

void Table::prepare(Points points) {
  points_ = std::move(points);
  for (const Point& point : points_.points) {
    if (point.at.focus == points_.points.front().at.focus) zooms_.push_back(point.at.zoom);
    if (focuses_.empty() || point.at.focus != focuses_.back()) focuses_.push_back(point.at.focus);
    const camera::Lens& lens = point.lens;
    Knot knot;
    knot.value << lens.image_distance, lens.center_shift.x(), lens.center_shift.y(), lens.k1, lens.k2;
    knot.slope.setZero();
    knots_.push_back(knot);
  }
  distances_ = points_.focus;

  const std::size_t last = zooms_.size() - 1;
  for (std::size_t begin = 0; begin < knots_.size(); begin += zooms_.size()) {
    Knot* const knots = &knots_[begin];
    const auto length = [&](std::size_t i) { return zooms_[i + 1] - zooms_[i]; };
    for (Eigen::Index k = 0; k < knots->value.size(); ++k) {
      const auto secant = [&](std::size_t i) { return (knots[i + 1].value[k] - knots[i].value[k]) / length(i); };
      for (std::size_t i = 1; i < last; ++i) {
        knots[i].slope[k] = slope_between(length(i - 1), length(i), secant(i - 1), secant(i));
      }
      const bool is_line = last == 1;
      knots[0].slope[k] = is_line ? secant(0) : slope_at_end(length(0), length(1), secant(0), secant(1));
      knots[last].slope[k] =
          is_line ? secant(0) : slope_at_end(length(last - 1), length(last - 2), secant(last - 1), secant(last - 2));
    }
  }
}

std::pair<double, double> Table::focus_range() const noexcept {
  if (focuses_.size() > 1) return {focuses_.front(), focuses_.back()};
  if (!distances_.empty()) return {distances_.front().count, distances_.back().count};
  return {0, 0};
}

Table::Values Table::slice_at(std::size_t focus, double zoom) const noexcept {
  const std::size_t i = interval_of(zooms_, zoom, identity);
  const Knot& a = knots_[focus * zooms_.size() + i];
  const Knot& b = knots_[focus * zooms_.size() + i + 1];
  const double length = zooms_[i + 1] - zooms_[i];
  const double t = (zoom - zooms_[i]) / length;
  if (points_.interpolation == Interpolation::linear) return a.value + t * (b.value - a.value);
  const double rest = 1 - t;
  return (1 + 2 * t) * rest * rest * a.value + t * t * (3 - 2 * t) * b.value +
         length * t * rest * (rest * a.slope - t * b.slope);
}

Table::Values Table::values_at(const Position& at) const noexcept {
  if (focuses_.size() == 1) return slice_at(0, at.zoom);
  const std::size_t i = interval_of(focuses_, at.focus, identity);
  const double t = (at.focus - focuses_[i]) / (focuses_[i + 1] - focuses_[i]);
  return (1 - t) * slice_at(i, at.zoom) + t * slice_at(i + 1, at.zoom);
}

std::optional<camera::Lens> Table::lens_at(const Position& at) const noexcept {
  const auto zoom = clamped(at.zoom, zooms_.front(), zooms_.back());
  if (!zoom) return std::nullopt;
  Position inside{*zoom, 0};
  if (focuses_.size() > 1) {
    const auto focus = clamped(at.focus, focuses_.front(), focuses_.back());
    if (!focus) return std::nullopt;
    inside.focus = *focus;
  }
  camera::Lens lens;
  if (!distances_.empty()) {
    const auto focus = clamped(at.focus, distances_.front().count, distances_.back().count);
    if (!focus) return std::nullopt;
    const std::size_t i = interval_of(distances_, *focus, count_of);
    const FocusPoint &a = distances_[i], &b = distances_[i + 1];
    const double t = (*focus - a.count) / (b.count - a.count);
    lens.focdist = 1 / ((1 - t) / a.distance + t / b.distance);
  }
  const Values values = values_at(inside);
  lens.image_distance = values[0];
  lens.center_shift = {values[1], values[2]};
  lens.k1 = values[3];
  lens.k2 = values[4];
  return lens;
}

std::optional<Position> Table::position_of(const camera::Lens& lens) const noexcept {
  Position at{0, focuses_.front()};
  if (!distances_.empty()) {
    const FocusPoint &first = distances_.front(), &last = distances_.back();
    const auto [near, far] = std::minmax({first.distance, last.distance});
    const auto nearness = clamped(1 / (lens.focdist > 0 ? lens.focdist : far), 1 / far, 1 / near);
    if (!nearness) return std::nullopt;
    const double sign = first.distance < last.distance ? -1 : 1;  // of nearness over counts
    const std::size_t i =
        interval_of(distances_, sign * *nearness, [sign](const FocusPoint& p) { return sign / p.distance; });
    const FocusPoint &a = distances_[i], &b = distances_[i + 1];
    const double t = (*nearness - 1 / a.distance) / (1 / b.distance - 1 / a.distance);
    at.focus = a.count + t * (b.count - a.count);
    if (focuses_.size() > 1) {
      const auto focus = clamped(at.focus, focuses_.front(), focuses_.back());
      if (!focus) return std::nullopt;
      at.focus = *focus;
    }
  } else if (focuses_.size() > 1) {
    // Distances are unknown: the last focus is used.
    at.focus = focuses_.back();
  }
  const auto image_distance = [&](double zoom) { return values_at({zoom, at.focus})[0]; };
  double low = zooms_.front(), high = zooms_.back();
  const auto [least, most] = std::minmax({image_distance(low), image_distance(high)});
  const auto wanted = clamped(lens.image_distance, least, most);
  if (!wanted) return std::nullopt;
  const bool rises = image_distance(high) > image_distance(low);
  if (*wanted == image_distance(high)) low = high;
  while (high - low > count_step) {
    const double middle = (low + high) / 2;
    ((image_distance(middle) <= *wanted) == rises ? low : high) = middle;
  }
  at.zoom = (low + high) / 2;
  return at;
}

}  // namespace trk_bridge::lens
