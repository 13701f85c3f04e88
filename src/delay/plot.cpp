#include "plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace trk_bridge::delay {
namespace {

constexpr double shown_time = 10;  // s
constexpr double width = 900, left = 70, right = 20, panel_height = 220;

struct Curve {
  std::vector<std::pair<double, double>> points;
  std::string style;  // attributes of SVG
  std::string name;
};

struct Ticks {
  double from, to, step;
};

/// About five round numbers a panel.
Ticks ticks(double from, double to) {
  const double raw = (to - from) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw / power < 2 ? 2 : raw / power < 5 ? 5 : 10);
  return {std::ceil(from / step) * step, to, step};
}

/// Axes and curves in a rectangle of the drawing.
class Panel {
 public:
  Panel(std::ostream& svg, double top, std::pair<double, double> x, std::pair<double, double> y)
      : svg_(svg), top_(top), x_(std::move(x)), y_(std::move(y)) {}

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
    for (const Curve& curve : curves) {
      svg_ << "<polyline fill='none' " << curve.style << " points='";
      for (const auto& [x, y] : curve.points) svg_ << px(x) << ',' << py(y) << ' ';
      svg_ << "'/>\n<line x1='" << at << "' x2='" << at + 24 << "' y1='" << top_ - 12 << "' y2='" << top_ - 12 << "' "
           << curve.style << "/>\n";
      text(at + 30, top_ - 8, "start", curve.name);
      at += 200;
    }
  }

 private:
  double px(double x) const { return left + (x - x_.first) / (x_.second - x_.first) * (width - left - right); }
  double py(double y) const { return top_ + panel_height - (y - y_.first) / (y_.second - y_.first) * panel_height; }

  static std::string label(double value, double step) {
    std::ostringstream text;
    text << std::round(value / step) * step + 0.0;
    return text.str();
  }
  void text(double x, double y, const char* anchor, const std::string& words) {
    svg_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "'>" << words << "</text>\n";
  }

  std::ostream& svg_;
  double top_;
  std::pair<double, double> x_, y_;
};

int axis_that_moved_most(const std::vector<Speeds>& speeds) {
  Turn squares = Turn::Zero();
  for (const auto& one : speeds) squares += one.picture.cwiseAbs2();
  int axis = 0;
  squares.maxCoeff(&axis);
  return axis;
}

}  // namespace

std::string to_svg(const Measurement& measurement, const std::string& title) {
  const int axis = axis_that_moved_most(measurement.speeds);
  const auto& quickest = *std::max_element(
      measurement.speeds.begin(), measurement.speeds.end(),
      [axis](const Speeds& a, const Speeds& b) { return std::abs(a.picture[axis]) < std::abs(b.picture[axis]); });
  const double last = measurement.speeds.back().time;
  const double from = std::clamp(quickest.time - shown_time / 2, 0.0, std::max(0.0, last - shown_time));
  const double to = std::min(from + shown_time, last);
  std::vector<Curve> curves = {
      {{}, "stroke='#222' stroke-width='2.5'", "picture"},
      {{}, "stroke='#d2691e' stroke-width='1.5' stroke-dasharray='5 3'", "tracking as stamped"},
      {{}, "stroke='#1e78d2' stroke-width='1.5'", "tracking delayed"}};
  double highest = 1;
  for (const auto& one : measurement.speeds) {
    if (one.time < from || one.time > to) continue;
    const std::array<double, 3> shown = {one.picture[axis], one.tracking[axis], one.tracking_delayed[axis]};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      curves[i].points.emplace_back(one.time, shown[i]);
      highest = std::max(highest, 1.1 * std::abs(shown[i]));
    }
  }

  std::ostringstream svg;
  const double height = 2 * panel_height + 180;
  svg << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height
      << "' font-family='sans-serif' font-size='12'>\n<rect width='" << width << "' height='" << height
      << "' fill='white'/>\n<text x='" << left << "' y='24' font-size='16'>" << title << "</text>\n";
  Panel speeds(svg, 64, {from, to}, {-highest, highest});
  speeds.axes("seconds", std::string(axis_names[static_cast<std::size_t>(axis)]) + ", pixels a second");
  speeds.curves(curves);

  constexpr double ms = 1e3;
  const auto& likeness = measurement.likeness;
  Curve correlation{{}, "stroke='#222' stroke-width='2'", "correlation"};
  for (const auto& one : likeness) correlation.points.emplace_back(one.delay * ms, one.correlation);
  Panel delays(svg, 64 + panel_height + 76, {likeness.front().delay * ms, likeness.back().delay * ms}, {0, 1});
  delays.axes("delay of tracking, ms", "correlation");
  const double found = measurement.delay * ms;
  delays.curves({correlation, {{{found, 0}, {found, 1}}, "stroke='#1e78d2' stroke-width='1.5'", "the video's delay"}});
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace trk_bridge::delay
