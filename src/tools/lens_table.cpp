// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "lens_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/number_text.h"
#include "plot/plot.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::tools {
namespace {

using base::general_text;

constexpr int steps = 400;  // of a curve

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  std::string text(const char* unit) const {
    return general_text(least) + (least < most ? " to " + general_text(most) : "") + " " + unit;
  }
  /// A little wider, and not empty.
  std::pair<double, double> for_axis() const {
    const double margin = std::max({0.05 * (most - least), 1e-3 * std::abs(most), 1e-9});
    return {least - margin, most + margin};
  }
};

/// A value of a lens that is plotted and printed.
using Value = std::function<double(const camera::Lens&)>;

/// The radius (mm) at which distortion is given, in percent of this radius: half of the chip's width, or 1 mm if the
/// chip is unknown.
double radius_of(const lens::Table& table) { return table.constants() ? table.constants()->chip_width / 2 : 1; }

Value distortion_at(double radius) {
  return [r2 = radius * radius](const camera::Lens& lens) { return 100 * (lens.k1 + lens.k2 * r2) * r2; };
}

double at_step(double first, double last, int step) { return first + (last - first) * step / steps; }

Range range_over(const lens::Table& table, const Value& value) {
  Range range;
  for (const double focus : {table.first().focus, table.last().focus}) {
    for (int i = 0; i <= steps; ++i) {
      const auto lens = table.lens_at({at_step(table.first().zoom, table.last().zoom, i), focus});
      if (lens) range.add(value(*lens));
    }
  }
  return range;
}

/// Whether the table depends on focus as well.
bool breathes(const lens::Table& table) {
  const auto& points = table.points().points;
  return points.front().at.focus != points.back().at.focus;
}

/// A curve over zoom at one focus, and the points of the table on it.
void add_curve(const lens::Table& table, double focus, const Value& value, const std::string& colour,
               const std::string& name, std::vector<plot::Curve>& curves) {
  plot::Curve curve{{}, "stroke='" + colour + "' stroke-width='2'", name};
  for (int i = 0; i <= steps; ++i) {
    const double zoom = at_step(table.first().zoom, table.last().zoom, i);
    if (const auto lens = table.lens_at({zoom, focus})) curve.points.emplace_back(zoom, value(*lens));
  }
  plot::Curve dots{{}, "fill='" + colour + "'", {}, true};
  for (const auto& point : table.points().points) {
    if (!breathes(table) || point.at.focus == focus) dots.points.emplace_back(point.at.zoom, value(point.lens));
  }
  curves.push_back(std::move(curve));
  curves.push_back(std::move(dots));
}

/// Plots `values` with their names, in different colours for the first and the last focus.
plot::Panel panel_over_zoom(const lens::Table& table, const std::string& y_name,
                            const std::vector<std::pair<std::string, Value>>& values) {
  constexpr std::array<std::pair<const char*, const char*>, 2> colours{
      {{"#1e78d2", "#8fc0ee"}, {"#d2691e", "#eebd96"}}};
  plot::Panel panel{"zoom encoder", y_name, {table.first().zoom, table.last().zoom}, {}, {}};
  Range range;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = values[i].first;
    const Value value = values[i].second;
    const auto add = [&](double focus, const char* colour) {
      add_curve(table, focus, value, colour, breathes(table) ? name + ", focus " + general_text(focus) : name,
                panel.curves);
    };
    add(table.first().focus, colours[i].first);
    if (breathes(table)) add(table.last().focus, colours[i].second);
    const Range of_value = range_over(table, value);
    range.add(of_value.least);
    range.add(of_value.most);
  }
  panel.y = range.for_axis();
  return panel;
}

double focal_length(const camera::Lens& lens) { return lens.image_distance; }
double shift_x(const camera::Lens& lens) { return lens.center_shift.x(); }
double shift_y(const camera::Lens& lens) { return lens.center_shift.y(); }

}  // namespace

std::vector<std::string> lines_of(const lens::Table& table) {
  const auto& points = table.points();
  std::vector<std::string> lines;
  lines.push_back(std::to_string(points.points.size()) + " points, " +
                  (points.interpolation == lens::Interpolation::pchip ? "pchip" : "linear") + " over zoom");
  Range zoom;
  zoom.add(table.first().zoom);
  zoom.add(table.last().zoom);
  lines.push_back("zoom: " + zoom.text("counts"));
  const Range lengths = range_over(table, focal_length);
  lines.push_back("focal length: " + lengths.text("mm"));
  if (const auto& constants = table.constants()) {
    const double chip = constants->chip_width;
    Range angles;
    for (const double length : {lengths.least, lengths.most}) {
      if (const auto angle = camera::field_of_view(length, chip)) angles.add(*angle);
    }
    lines.push_back("horizontal angle of view: " + angles.text("degrees") + " on a chip of " + general_text(chip) +
                    " mm");
  }
  lines.push_back("centre shift: x " + range_over(table, shift_x).text("mm") + ", y " +
                  range_over(table, shift_y).text("mm"));
  const double radius = radius_of(table);
  lines.push_back("distortion at " + general_text(radius) +
                  " mm from the optical axis: " + range_over(table, distortion_at(radius)).text("%"));
  if (table.has_distances()) {
    Range distances;
    for (const auto& point : points.focus) distances.add(point.distance);
    lines.push_back("focus: " + general_text(points.focus.front().count) + " to " +
                    general_text(points.focus.back().count) + " counts, " + distances.text("m"));
  } else {
    lines.emplace_back("focus: distances are not known");
  }
  if (!table.constants()) {
    lines.emplace_back("constants: none; takes need them, and nodes need them as parameter");
  }
  return lines;
}

std::string to_svg(const lens::Table& table, const std::string& title) {
  const double radius = radius_of(table);
  std::vector<plot::Panel> panels{panel_over_zoom(table, "focal length, mm", {{"focal length", focal_length}}),
                                  panel_over_zoom(table, "centre shift, mm", {{"x", shift_x}, {"y", shift_y}}),
                                  panel_over_zoom(table, "distortion " + general_text(radius) + " mm from the axis, %",
                                                  {{"distortion", distortion_at(radius)}})};
  if (table.has_distances()) {
    const auto& focus = table.points().focus;
    plot::Curve curve{{}, "stroke='#1e78d2' stroke-width='2'", "distance"}, dots{{}, "fill='#1e78d2'", {}, true};
    Range range;
    for (int i = 0; i <= steps; ++i) {
      const double count = at_step(focus.front().count, focus.back().count, i);
      const auto lens = table.lens_at({table.first().zoom, count});
      if (!lens) continue;
      curve.points.emplace_back(count, lens->focdist);
      range.add(lens->focdist);
    }
    for (const auto& point : focus) dots.points.emplace_back(point.count, point.distance);
    panels.push_back({"focus encoder",
                      "focus distance, m",
                      {focus.front().count, focus.back().count},
                      range.for_axis(),
                      {std::move(curve), std::move(dots)}});
  }
  return plot::to_svg(title, panels);
}

}  // namespace trk_bridge::tools
