// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_figure.h"

#include <cmath>

#include "base/number_text.h"

namespace trk_bridge::demo {
namespace {

/// Every second point of every second line is labelled with its coordinates.
constexpr int labelled = 2;

int cells(double length, double spacing) {
  constexpr double rounding = 1e-9;
  return static_cast<int>(std::floor(length / spacing + rounding));
}

std::string coordinates(const Eigen::Vector3d& place) {
  using base::general_text;
  return general_text(place.x()) + ' ' + general_text(place.y()) + ' ' + general_text(place.z());
}

}  // namespace

Figure figure_at(const Place& place) {
  const int columns = cells(place.width, place.spacing), rows = cells(place.depth, place.spacing),
            levels = cells(place.height, place.spacing);
  const auto at = [&](int column, int row, int level) {
    return Eigen::Vector3d(place.x + (column - columns / 2.0) * place.spacing, place.y - row * place.spacing,
                           level * place.spacing);
  };
  Figure figure;
  for (int column = 0; column <= columns; ++column) {
    figure.floor.push_back({at(column, 0, 0), at(column, rows, 0)});
    figure.wall.push_back({at(column, 0, 0), at(column, 0, levels)});
  }
  for (int row = 0; row <= rows; ++row) figure.floor.push_back({at(0, row, 0), at(columns, row, 0)});
  for (int level = 1; level <= levels; ++level) figure.wall.push_back({at(0, 0, level), at(columns, 0, level)});

  const auto add_point = [&](int column, int row, int level) {
    const Eigen::Vector3d point = at(column, row, level);
    const bool bears_label = column % labelled == 0 && (row + level) % labelled == 0;
    figure.points.push_back({point, bears_label ? coordinates(point) : ""});
  };
  for (int column = 0; column <= columns; ++column) {
    for (int row = 0; row <= rows; ++row) add_point(column, row, 0);
    for (int level = 1; level <= levels; ++level) add_point(column, 0, level);
  }
  return figure;
}

}  // namespace trk_bridge::demo
