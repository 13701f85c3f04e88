// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "rigid.h"

#include <cmath>
#include <cstddef>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire {

bool is_affine(const std::array<double, 16>& m) noexcept {
  constexpr double tolerance = 1e-6;
  const auto near = [](double value, double expected) {
    return !std::isfinite(value) || std::abs(value - expected) <= tolerance;
  };
  return near(m[3], 0) && near(m[7], 0) && near(m[11], 0) && near(m[15], 1);
}

bool is_rigid(const std::array<double, 16>& m) noexcept {
  constexpr double tolerance = 1e-3;
  if (!is_affine(m)) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      double dot = 0;
      for (std::size_t i = 0; i < 3; ++i) dot += m[4 * a + i] * m[4 * b + i];
      // This form rejects NaN.
      if (!(std::abs(dot - (a == b ? 1 : 0)) <= tolerance)) return false;
    }
  }
  const double determinant =
      m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]);
  return determinant > 0;
}

}  // namespace trk_bridge::wire
