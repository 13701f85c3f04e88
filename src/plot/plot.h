// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Draws curves with axes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trk_bridge::plot {

struct Curve {
  std::vector<std::pair<double, double>> points;
  std::string style;      ///< SVG attributes
  std::string name;       ///< in the legend; empty: not in the legend
  bool has_dots = false;  ///< draws the points, without a line between them
};

/// One pair of axes. Ranges must not be empty.
struct Panel {
  std::string x_name, y_name;
  std::pair<double, double> x, y;  ///< from, to
  std::vector<Curve> curves;
};

/// Returns an SVG: the panels one below the other, with `title` above.
std::string to_svg(const std::string& title, const std::vector<Panel>& panels);

}  // namespace trk_bridge::plot
