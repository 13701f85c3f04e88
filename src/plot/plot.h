// Curves over axes, as a drawing.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trk_bridge::plot {

struct Curve {
  std::vector<std::pair<double, double>> points;
  std::string style;      ///< attributes of SVG
  std::string name;       ///< of the legend; empty: it has none
  bool has_dots = false;  ///< the points are drawn, and no line between them
};

/// One pair of axes. Ranges must not be empty.
struct Panel {
  std::string x_name, y_name;
  std::pair<double, double> x, y;  ///< from, to
  std::vector<Curve> curves;
};

/// An SVG: the panels below each other, `title` above them.
std::string to_svg(const std::string& title, const std::vector<Panel>& panels);

}  // namespace trk_bridge::plot
