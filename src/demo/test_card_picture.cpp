// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_picture.h"

#include <utility>
#include <vector>

#include "test_card_canvas.h"

namespace trk_bridge::demo {

void draw(const Figure& figure, const View& view, cv::Mat& picture) {
  Canvas canvas(picture, background);
  canvas.clear();
  Polyline seen;
  for (const auto& [lines, level] : {std::pair(&figure.floor, floor_level), std::pair(&figure.wall, wall_level)}) {
    for (const Line& line : *lines) {
      view.see(line, seen);
      canvas.line(seen, line_half_width, level);
    }
  }
  std::vector<std::pair<Eigen::Vector2d, const Point*>> points;
  for (const Point& point : figure.points) {
    const auto pixel = view.see(point.place);
    if (pixel) points.emplace_back(*pixel, &point);
  }
  // All cleared areas first, then all discs: points close together must not cut off each other's discs.
  for (const auto& [pixel, point] : points) canvas.disc(pixel, clear_radius, background);
  for (const auto& [pixel, point] : points) canvas.disc(pixel, point_radius, point_level);
  for (const auto& [pixel, point] : points) {
    if (!point->label.empty()) canvas.label(point->label, pixel, clear_radius, label_level);
  }
}

}  // namespace trk_bridge::demo
