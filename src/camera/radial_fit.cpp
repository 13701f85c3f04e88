// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "radial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "least_squares.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera {
namespace {

constexpr int sample_count = 48;
constexpr int check_count = 400;
constexpr int reweightings = 3;

/// The curve to be fitted.
struct Curve {
  double a1, a2, reach;

  double undistorted(double distorted) const noexcept {
    const double squared = distorted * distorted;
    return distorted * (1 + squared * (a1 + squared * a2));
  }
};

double residual_of(const Curve& curve, const RadialModel& model) noexcept {
  double worst = 0;
  for (int i = 1; i <= check_count; ++i) {
    const double distorted = curve.reach * i / check_count;
    const double error = std::abs(model.distorted(curve.undistorted(distorted)).value - distorted);
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, error);
  }
  return worst;
}

struct Sample {
  double undistorted, ratio;
};
using Samples = std::array<Sample, sample_count>;

Samples sample(const Curve& curve) noexcept {
  Samples samples;
  for (int i = 0; i < sample_count; ++i) {
    const double distorted = curve.reach * chebyshev_node(i, sample_count);
    const double undistorted = curve.undistorted(distorted);
    samples[static_cast<std::size_t>(i)] = {undistorted, distorted / undistorted};
  }
  return samples;
}

/// One fit with `above` coefficients in the numerator and `below` in the denominator. The weight of a sample is its
/// radius divided by the denominator of `weights`.
RadialModel fit_weighted(const Samples& samples, int above, int below, const RadialModel& weights) noexcept {
  Terms terms(sample_count, above + below);
  Values wanted(sample_count);
  for (int i = 0; i < sample_count; ++i) {
    const auto [undistorted, ratio] = samples[static_cast<std::size_t>(i)];
    const double s = undistorted * undistorted;
    const double weight = undistorted / weights.denominator(s);
    wanted[i] = weight * (ratio - 1);
    double power = weight;
    for (int j = 0; j < std::max(above, below); ++j) {
      power *= s;
      if (j < above) terms(i, j) = power;
      if (j < below) terms(i, above + j) = -ratio * power;
    }
  }
  const Unknowns k = least_squares(terms, wanted);
  RadialModel model;
  std::copy_n(k.data(), above, model.k.begin());
  std::copy_n(k.data() + above, below, model.k.begin() + 3);
  return model;
}

RadialModel fit_polynomial(const Samples& samples) noexcept { return fit_weighted(samples, 3, 0, {}); }

/// After multiplication by the denominator, the problem is linear in the coefficients. The denominator of the previous
/// fit compensates the weight that this adds.
RadialModel fit_rational(const Samples& samples, int above, int below) noexcept {
  RadialModel model;
  for (int i = 0; i < reweightings; ++i) model = fit_weighted(samples, above, below, model);
  return model;
}

/// The range that should have no pole, for points just outside of the image: a quarter more than the image, or up to
/// the fold of the lens.
double wanted_range(const Curve& curve) noexcept {
  constexpr double quarter_more = 1.25;
  Lens lens;
  lens.k1 = curve.a1;
  lens.k2 = curve.a2;
  const double fold = monotonic_radius(lens);
  return std::isfinite(fold) ? std::clamp(curve.undistorted(fold), 1.0, quarter_more) : quarter_more;
}

/// Replaces `best` if `radial` has no pole within `range` and a smaller residual. Returns whether it has no pole.
bool take_if_better(const Curve& curve, const RadialModel& radial, double range, RadialFit& best) noexcept {
  if (!radial.has_no_pole(range)) return false;
  const double residual = residual_of(curve, radial);
  if (residual < best.residual) best = {DistortionModel::rational_polynomial, radial, residual};
  return true;
}

void improve_by_rationals(const Curve& curve, const Samples& samples, double tolerance, RadialFit& best) noexcept {
  const RadialModel full = fit_rational(samples, 3, 3);
  const double range = wanted_range(curve);
  if (take_if_better(curve, full, range, best)) return;
  // If six coefficients are more than the curve needs, the fit has a pole next to a zero.
  const std::array<RadialModel, 3> lesser = {fit_rational(samples, 3, 2), fit_rational(samples, 2, 3),
                                             fit_rational(samples, 2, 2)};
  for (const RadialModel& radial : lesser) take_if_better(curve, radial, range, best);
  if (best.residual <= tolerance || take_if_better(curve, full, 1, best)) return;
  for (const RadialModel& radial : lesser) take_if_better(curve, radial, 1, best);
}

}  // namespace

double RadialModel::denominator(double s) const noexcept { return 1 + s * (k[3] + s * (k[4] + s * k[5])); }

ValueAndSlope RadialModel::distorted(double r) const noexcept {
  const double s = r * r;
  const double above = 1 + s * (k[0] + s * (k[1] + s * k[2]));
  const double below = denominator(s);
  const double above_slope = k[0] + s * (2 * k[1] + s * 3 * k[2]);
  const double below_slope = k[3] + s * (2 * k[4] + s * 3 * k[5]);
  const double ratio = above / below;
  return {r * ratio, ratio + 2 * s * (above_slope - ratio * below_slope) / below};
}

bool RadialModel::has_no_pole(double r) const noexcept {
  const double end = r * r;
  if (!(denominator(end) > 0)) return false;
  // The smallest value is at an end or where 3 k6 s^2 + 2 k5 s + k4 = 0.
  const double discriminant = k[4] * k[4] - 3 * k[5] * k[3];
  if (!(discriminant >= 0)) return true;
  const double q = -(k[4] + std::copysign(std::sqrt(discriminant), k[4]));
  for (const double s : {q / (3 * k[5]), k[3] / q}) {
    if (s > 0 && s < end && !(denominator(s) > 0)) return false;
  }
  return true;
}

Result<RadialFit> fit_radial(double a1, double a2, double reach, double tolerance) noexcept {
  if (a1 == 0 && a2 == 0) return RadialFit{};
  const Curve curve{a1, a2, reach};
  const Samples samples = sample(curve);
  RadialFit best;
  best.radial = fit_polynomial(samples);
  best.residual = residual_of(curve, best.radial);
  if (!(best.residual <= tolerance)) improve_by_rationals(curve, samples, tolerance, best);
  if (!std::isfinite(best.residual)) return tl::unexpected(CameraReason::no_fit);
  return best;
}

}  // namespace trk_bridge::camera
