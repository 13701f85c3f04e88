// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_canvas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace trk_bridge::demo {
namespace {

/// Half the width of the soft transition at an edge, pixels.
constexpr float softness = 1.5F;

/// Coverage of a point that is `inside` pixels inside an edge: the integral of a quadratic B-spline.
float covered(float inside) {
  if (inside <= -softness) return 0;
  if (inside >= softness) return 1;
  const float from_end = softness - std::abs(inside);
  if (from_end >= 1) return 0.5F + inside * (0.75F - inside * inside / 3);
  const float tail = from_end * from_end * from_end / 6;
  return inside < 0 ? tail : 1 - tail;
}

std::uint8_t mixed(float part, std::uint8_t from, std::uint8_t to) {
  constexpr float rounding = 0.5F;
  return static_cast<std::uint8_t>(static_cast<float>(from) + part * static_cast<float>(to - from) + rounding);
}

/// Whole numbers from..to (both included) within `around` of `center` and 0..`size` - 1.
struct Span {
  Span(double center, double around, int size)
      : from(static_cast<int>(std::ceil(std::clamp(center - around, 0.0, double(size))))),
        to(static_cast<int>(std::floor(std::clamp(center + around, -1.0, double(size - 1))))) {}
  int from, to;
};

}  // namespace

Canvas::Canvas(cv::Mat& picture, std::uint8_t background) : picture_(picture), background_(background) {}

void Canvas::clear() { picture_.setTo(cv::Scalar(background_)); }

void Canvas::line(const std::vector<Eigen::Vector2d>& polyline, double half_width, std::uint8_t level) {
  for (std::size_t i = 1; i < polyline.size(); ++i) segment(polyline[i - 1], polyline[i], half_width, level);
}

void Canvas::segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_width, std::uint8_t level) {
  const Eigen::Vector2d along = to - from;
  const double length = along.norm();
  if (!(length > 0)) return;
  const Eigen::Vector2d direction = along / length;
  // Pixel by pixel along the axis that is closer to the line, and across it over the width of the line.
  const int major = std::abs(direction.x()) >= std::abs(direction.y()) ? 0 : 1, minor = 1 - major;
  const int sizes[2] = {picture_.cols, picture_.rows};
  const double reach = half_width + softness, slope = along[minor] / along[major];
  const double across = reach / std::abs(direction[major]);
  const std::size_t steps[2] = {1, picture_.step};
  const auto f = [](double value) { return static_cast<float>(value); };
  const Span span((from[major] + to[major]) / 2, std::abs(along[major]) / 2 + reach, sizes[major]);
  for (int i = span.from; i <= span.to; ++i) {
    const Span rows(from[minor] + (i - from[major]) * slope, across, sizes[minor]);
    if (rows.from > rows.to) continue;
    // For the first pixel: position along the segment and distance from it; both are linear from there.
    Eigen::Vector2d first;
    first[major] = i - from[major];
    first[minor] = rows.from - from[minor];
    float run = f(first.dot(direction)), aside = f(direction.x() * first.y() - direction.y() * first.x());
    const float run_step = f(direction[minor]), aside_step = f(major == 0 ? direction.x() : -direction.y());
    std::uint8_t* pixel =
        picture_.data + steps[major] * static_cast<std::size_t>(i) + steps[minor] * static_cast<std::size_t>(rows.from);
    for (int j = rows.from; j <= rows.to; ++j, pixel += steps[minor], run += run_step, aside += aside_step) {
      const float past = std::max({-run, run - f(length), 0.0F});
      const float distance = past > 0 ? std::sqrt(past * past + aside * aside) : std::abs(aside);
      *pixel = std::max(*pixel, mixed(covered(f(half_width) - distance), background_, level));
    }
  }
}

void Canvas::disc(const Eigen::Vector2d& center, double radius, std::uint8_t level) {
  const Span rows(center.y(), radius + softness, picture_.rows), columns(center.x(), radius + softness, picture_.cols);
  for (int v = rows.from; v <= rows.to; ++v) {
    auto* row = picture_.ptr<std::uint8_t>(v);
    for (int u = columns.from; u <= columns.to; ++u) {
      const double distance = std::hypot(u - center.x(), v - center.y());
      row[u] = mixed(covered(static_cast<float>(radius - distance)), row[u], level);
    }
  }
}

bool Canvas::is_free(const cv::Rect& area) const {
  if ((area & cv::Rect(0, 0, picture_.cols, picture_.rows)) != area) return false;
  double brightest = 0;
  cv::minMaxLoc(picture_(area), nullptr, &brightest);
  return brightest <= background_;
}

void Canvas::label(const std::string& text, const Eigen::Vector2d& center, double radius, std::uint8_t level) {
  constexpr int font = cv::FONT_HERSHEY_SIMPLEX, thickness = 1, clearance = 4;
  constexpr double scale = 0.5;
  // Positions beyond this are outside the picture and could overflow an integer.
  if (!(center.cwiseAbs().maxCoeff() < std::numeric_limits<std::int16_t>::max())) return;
  int below = 0;
  const cv::Size size = cv::getTextSize(text, font, scale, thickness, &below);
  const int gap = static_cast<int>(radius) + clearance;
  const int u = static_cast<int>(center.x()), v = static_cast<int>(center.y());
  for (const int top : {v + gap, v - gap - size.height - below}) {
    for (const int left : {u + gap, u - gap - size.width}) {
      const cv::Rect area(left - clearance, top - clearance, size.width + 2 * clearance,
                          size.height + below + 2 * clearance);
      if (!is_free(area)) continue;
      cv::putText(picture_, text, {left, top + size.height}, font, scale, cv::Scalar(level), thickness, cv::LINE_AA);
      return;
    }
  }
}

}  // namespace trk_bridge::demo
