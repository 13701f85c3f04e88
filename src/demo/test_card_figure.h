// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The content of the test card: grids on the floor of the studio and on a wall behind it, and the points where their
// lines cross.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace trk_bridge::demo {

/// Position and size of the card in the studio, metres. The wall is parallel to the x axis of the studio and faces it.
struct Place {
  double x = 0, y = 12;  ///< the middle of the line between wall and floor
  double width = 16;     ///< of wall and floor
  double depth = 12;     ///< of the floor, from the wall towards smaller y
  double height = 5;     ///< of the wall
  double spacing = 1;    ///< of the lines; only whole cells are drawn
};

/// Limit of cells across the floor or the wall; checked where a Place is read.
inline constexpr int most_cells = 100;

struct Line {
  Eigen::Vector3d from, to;
};

struct Point {
  Eigen::Vector3d place;
  std::string label;  ///< its x, y and z in metres; empty for most of them
};

/// All in the studio frame, metres.
struct Figure {
  std::vector<Line> floor, wall;  ///< their common line belongs to the floor
  std::vector<Point> points;
};

Figure figure_at(const Place&);

}  // namespace trk_bridge::demo
