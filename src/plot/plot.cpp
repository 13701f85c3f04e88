// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "base/number_text.h"

namespace trk_bridge::plot {
namespace {

constexpr double width = 900, left = 70, right = 20;
constexpr double panel_height = 220, first_top = 64, between_panels = 76, bottom = 40;

struct Ticks {
  double from, to, step;
};

/// About five round numbers per panel.
Ticks ticks(double from, double to) {
  const double raw = (to - from) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw / power < 2 ? 2 : raw / power < 5 ? 5 : 10);
  return {std::ceil(from / step) * step, to, step};
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '&') {
      all += "&amp;";
    } else if (c == '<') {
      all += "&lt;";
    } else {
      all += c;
    }
  }
  return all;
}

/// Draws a panel in a rectangle of the drawing.
class Rectangle {
 public:
  Rectangle(std::ostream& svg, double top, const Panel& panel) : svg_(svg), top_(top), x_(panel.x), y_(panel.y) {
    axes(panel.x_name, panel.y_name);
    curves(panel.curves);
  }

 private:
  void axes(const std::string& x_name, const std::string& y_name) {
    svg_ << "<rect x='" << left << "' y='" << top_ << "' width='" << width - left - right << "' height='"
         << panel_height << "' fill='none' stroke='#888'/>\n";
    for (auto [at, to, step] = ticks(x_.first, x_.second); at <= to + step * 1e-6; at += step) {
      svg_ << "<line x1='" << px(at) << "' x2='" << px(at) << "' y1='" << top_ << "' y2='" << top_ + panel_height
           << "' stroke='#ddd'/>\n";
      text(px(at), top_ + panel_height + 16, "middle", label(at, step));
    }
    for (auto [at, to, step] = ticks(y_.first, y_.second); at <= to + step * 1e-6; at += step) {
      svg_ << "<line x1='" << left << "' x2='" << width - right << "' y1='" << py(at) << "' y2='" << py(at)
           << "' stroke='#ddd'/>\n";
      text(left - 6, py(at) + 4, "end", label(at, step));
    }
    text((left + width - right) / 2, top_ + panel_height + 34, "middle", x_name);
    text(left, top_ - 8, "start", y_name);
  }

  void curves(const std::vector<Curve>& curves) {
    double at = left + 240;
    const auto named = std::count_if(curves.begin(), curves.end(), [](const Curve& c) { return !c.name.empty(); });
    const double step = std::min(200.0, (width - right - at) / static_cast<double>(std::max<std::ptrdiff_t>(named, 1)));
    for (const Curve& curve : curves) {
      if (curve.has_dots) {
        for (const auto& [x, y] : curve.points) {
          svg_ << "<circle r='3' cx='" << px(x) << "' cy='" << py(y) << "' " << curve.style << "/>\n";
        }
        continue;
      }
      svg_ << "<polyline fill='none' " << curve.style << " points='";
      for (const auto& [x, y] : curve.points) svg_ << px(x) << ',' << py(y) << ' ';
      svg_ << "'/>\n";
      if (curve.name.empty()) continue;
      svg_ << "<line x1='" << at << "' x2='" << at + 24 << "' y1='" << top_ - 12 << "' y2='" << top_ - 12 << "' "
           << curve.style << "/>\n";
      text(at + 30, top_ - 8, "start", curve.name);
      at += step;
    }
  }

  double px(double x) const { return left + (x - x_.first) / (x_.second - x_.first) * (width - left - right); }
  double py(double y) const { return top_ + panel_height - (y - y_.first) / (y_.second - y_.first) * panel_height; }

  static std::string label(double value, double step) {
    return base::general_text(std::round(value / step) * step + 0.0);
  }
  void text(double x, double y, const char* anchor, const std::string& words) {
    svg_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "'>" << escaped(words) << "</text>\n";
  }

  std::ostream& svg_;
  const double top_;
  const std::pair<double, double> x_, y_;
};

}  // namespace

std::string to_svg(const std::string& title, const std::vector<Panel>& panels) {
  std::ostringstream svg;
  svg.imbue(std::locale::classic());
  const auto count = static_cast<double>(panels.size());
  const double height = first_top + count * panel_height + (count - 1) * between_panels + bottom;
  svg << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height
      << "' font-family='sans-serif' font-size='12'>\n<rect width='" << width << "' height='" << height
      << "' fill='white'/>\n<text x='" << left << "' y='24' font-size='16'>" << escaped(title) << "</text>\n";
  double top = first_top;
  for (const Panel& panel : panels) {
    const Rectangle drawn(svg, top, panel);
    top += panel_height + between_panels;
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace trk_bridge::plot
