#include "radial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera {
namespace {

constexpr int node_count = 48;
constexpr int probe_count = 400;
constexpr int reweightings = 3;

using Nodes = Eigen::Array<double, node_count, 1>;
using PolynomialTerms = Eigen::Matrix<double, node_count, 3>;

/// What is fitted.
struct Curve {
  double a1, a2, reach;

  template <typename Radius>
  Radius undistorted(const Radius& distorted) const {
    const Radius squared = distorted * distorted;
    return distorted * (1 + squared * (a1 + squared * a2));
  }
};

/// Radii in the manner of Chebyshev, which spreads a least squares error evenly over the range.
Nodes chebyshev_radii() noexcept { return ((Nodes::LinSpaced(1, node_count) - 0.5) * (M_PI_2 / node_count)).sin(); }

double residual_of(const Curve& curve, const RadialModel& model) noexcept {
  double worst = 0;
  for (int i = 1; i <= probe_count; ++i) {
    const double distorted = curve.reach * i / probe_count;
    const double error = std::abs(model.distorted(curve.undistorted(distorted)).value - distorted);
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, error);
  }
  return worst;
}

struct Samples {
  Nodes undistorted, ratio;
  PolynomialTerms powers;  ///< s, s^2, s^3
};

Samples sample(const Curve& curve) noexcept {
  const Nodes distorted = curve.reach * chebyshev_radii();
  Samples samples;
  samples.undistorted = curve.undistorted(distorted);
  samples.ratio = distorted / samples.undistorted;
  const Nodes s = samples.undistorted.square();
  samples.powers << s, s.square(), s.cube();
  return samples;
}

RadialModel fit_polynomial(const Samples& samples) noexcept {
  const auto weight = samples.undistorted.matrix().asDiagonal();
  const PolynomialTerms terms = weight * samples.powers;
  const Eigen::Matrix<double, node_count, 1> wanted = weight * (samples.ratio - 1).matrix();
  const Eigen::Vector3d k = terms.colPivHouseholderQr().solve(wanted);
  return {{k[0], k[1], k[2], 0, 0, 0}};
}

/// Linear in the coefficients once multiplied by the denominator, whose last value undoes the weight that this gives.
/// `above` and `below` are the numbers of coefficients.
template <int above, int below>
RadialModel fit_rational(const Samples& samples) noexcept {
  RadialModel model;
  Nodes weight = samples.undistorted;
  for (int i = 0; i < reweightings; ++i) {
    Eigen::Matrix<double, node_count, above + below> terms;
    terms << samples.powers.leftCols<above>(),
        -(samples.ratio.matrix().asDiagonal() * samples.powers.leftCols<below>());
    terms = (weight.matrix().asDiagonal() * terms).eval();
    const Eigen::Matrix<double, node_count, 1> wanted = (weight * (samples.ratio - 1)).matrix();
    const Eigen::Matrix<double, above + below, 1> k = terms.completeOrthogonalDecomposition().solve(wanted);
    std::copy_n(k.data(), above, model.k.begin());
    std::copy_n(k.data() + above, below, model.k.begin() + 3);
    weight = samples.undistorted / (1 + (samples.powers.leftCols<below>() * k.template tail<below>()).array());
  }
  return model;
}

/// How far the model should go on without a pole, for points that are just outside of the image: a quarter of the
/// range, unless the lens itself folds before.
double wanted_range(const Curve& curve) noexcept {
  constexpr double quarter_more = 1.25;
  Lens lens;
  lens.k1 = curve.a1;
  lens.k2 = curve.a2;
  const double fold = monotonic_radius(lens);
  return std::isfinite(fold) ? std::clamp(curve.undistorted(fold), 1.0, quarter_more) : quarter_more;
}

/// Takes `radial` when it has no pole within `range` and is nearer than `best`; says whether it had none.
bool take_if_better(const Curve& curve, const RadialModel& radial, double range, RadialFit& best) noexcept {
  if (!radial.has_no_pole(range)) return false;
  const double residual = residual_of(curve, radial);
  if (residual < best.residual) best = {DistortionModel::rational_polynomial, radial, residual};
  return true;
}

void improve_by_rationals(const Curve& curve, const Samples& samples, double tolerance, RadialFit& best) noexcept {
  const RadialModel full = fit_rational<3, 3>(samples);
  const double range = wanted_range(curve);
  if (take_if_better(curve, full, range, best)) return;
  // Where six coefficients are more than the curve asks for, they spend the rest on a pole next to a zero.
  const std::array<RadialModel, 3> lesser = {fit_rational<3, 2>(samples), fit_rational<2, 3>(samples),
                                             fit_rational<2, 2>(samples)};
  for (const RadialModel& radial : lesser) take_if_better(curve, radial, range, best);
  if (best.residual <= tolerance || take_if_better(curve, full, 1, best)) return;
  for (const RadialModel& radial : lesser) take_if_better(curve, radial, 1, best);
}

}  // namespace

ValueAndSlope RadialModel::distorted(double r) const noexcept {
  const double s = r * r;
  const double above = 1 + s * (k[0] + s * (k[1] + s * k[2]));
  const double below = 1 + s * (k[3] + s * (k[4] + s * k[5]));
  const double above_slope = k[0] + s * (2 * k[1] + s * 3 * k[2]);
  const double below_slope = k[3] + s * (2 * k[4] + s * 3 * k[5]);
  const double ratio = above / below;
  return {r * ratio, ratio + 2 * s * (above_slope - ratio * below_slope) / below};
}

bool RadialModel::has_no_pole(double r) const noexcept {
  const auto below = [this](double s) { return 1 + s * (k[3] + s * (k[4] + s * k[5])); };
  const double end = r * r;
  if (!(below(end) > 0)) return false;
  // The smallest value is at an end or where 3 k6 s^2 + 2 k5 s + k4 = 0.
  const double discriminant = k[4] * k[4] - 3 * k[5] * k[3];
  if (!(discriminant >= 0)) return true;
  const double q = -(k[4] + std::copysign(std::sqrt(discriminant), k[4]));
  for (const double s : {q / (3 * k[5]), k[3] / q}) {
    if (s > 0 && s < end && !(below(s) > 0)) return false;
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
