// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Radial distortion from undistorted to distorted in the model of OpenCV, fitted to the polynomial of the document. All
// radii are in units of the largest undistorted one.
#pragma once

#include <array>

#include "numeric.h"
#include "trk_bridge/camera/calibration.h"

namespace trk_bridge::camera {

/// r_d / r_u as a function of the squared undistorted radius s: (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6
/// s^3).
struct RadialModel {
  std::array<double, 6> k{};

  double denominator(double s) const noexcept;
  /// The distorted radius and its slope at undistorted radius r.
  ValueAndSlope distorted(double r) const noexcept;
  /// Whether the denominator stays positive for radii up to r.
  bool has_no_pole(double r) const noexcept;
};

struct RadialFit {
  DistortionModel model = DistortionModel::plumb_bob;
  RadialModel radial;
  double residual = 0;  ///< worst error of the distorted radius
};

/// Fits r_u = r_d (1 + a1 r_d^2 + a2 r_d^4), which must increase for 0 <= r_d <= reach, with r_u = 1 at reach. Returns
/// plumb_bob if its residual is at most `tolerance`, else the best of plumb_bob and of rational_polynomials without a
/// pole in this range, even if its residual is large. no_fit if the result is not finite.
[[nodiscard]] Result<RadialFit> fit_radial(double a1, double a2, double reach, double tolerance) noexcept;

}  // namespace trk_bridge::camera
