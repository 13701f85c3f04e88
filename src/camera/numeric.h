// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Angles and roots.
#pragma once

#include <cmath>
#include <limits>

namespace trk_bridge::camera {

inline constexpr double degrees_per_radian = 180.0 / M_PI;

/// The i-th of `count` nodes between 0 and 1 for a fit. They are Chebyshev nodes, which distribute the error of least
/// squares evenly over the range.
inline double chebyshev_node(int i, int count) noexcept { return std::sin((i + 0.5) * (M_PI_2 / count)); }

/// Value and slope of a function at one point.
struct ValueAndSlope {
  double value = 0, slope = 0;
};

/// The root of an increasing `function` (double to ValueAndSlope), to full precision. `low` and `high` enclose the
/// root, `start` is between them. Uses Newton steps inside of this interval, else bisection.
template <typename Function>
double increasing_root(const Function& function, double low, double high, double start) noexcept {
  constexpr int more_than_halving_ever_takes = 2200;
  double x = start;
  for (int i = 0; i < more_than_halving_ever_takes; ++i) {
    const ValueAndSlope at = function(x);
    if (at.value == 0) return x;
    (at.value > 0 ? high : low) = x;
    const double step = at.value / at.slope;
    double next = x - step;
    if (std::abs(step) <= 2 * std::numeric_limits<double>::epsilon() * std::abs(x)) return next;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (next <= low || next >= high) return next;
    x = next;
  }
  return x;
}

}  // namespace trk_bridge::camera
