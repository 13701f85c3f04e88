// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "plot/plot.h"

namespace trk_bridge::delay {
namespace {

constexpr double shown_time = 10;  // s

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
  std::vector<plot::Curve> curves = {
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

  plot::Panel speeds{"seconds",
                     std::string(axis_names[static_cast<std::size_t>(axis)]) + ", pixels a second",
                     {from, to},
                     {-highest, highest},
                     std::move(curves)};

  constexpr double ms = 1e3;
  const auto& correlations = measurement.correlations;
  plot::Curve correlation{{}, "stroke='#222' stroke-width='2'", "correlation"};
  for (const auto& one : correlations) correlation.points.emplace_back(one.delay * ms, one.correlation);
  const double found = measurement.delay * ms;
  plot::Panel delays{
      "delay of tracking, ms",
      "correlation",
      {correlations.front().delay * ms, correlations.back().delay * ms},
      {0, 1},
      {correlation, {{{found, 0}, {found, 1}}, "stroke='#1e78d2' stroke-width='1.5'", "the video's delay"}}};
  return plot::to_svg(title, {std::move(speeds), std::move(delays)});
}

}  // namespace trk_bridge::delay
