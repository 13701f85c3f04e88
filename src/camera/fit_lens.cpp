// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Fits a lens to a CameraInfo or to another distortion.
#include <algorithm>
#include <cmath>
#include <optional>

#include "least_squares.h"
#include "numeric.h"
#include "opencv_lens.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera {
namespace {

constexpr int node_count = 64;
constexpr int probe_count = 400;
constexpr int border_points = 32;

/// The curve to be fitted: the inverse of D up to the largest distorted radius.
struct View {
  OpenCvLens lens;
  LensInverse inverse;
  double reach = 0;
};

/// An undistorted radius, and the slope of the distorted radius there.
struct Undistorted {
  double radius = 0, slope = 0;
};

/// Sets k1 and k2 of `lens` by least squares of the distorted radius. `undistort` (double to Undistorted) accepts
/// distorted radii up to `reach`; its radii and `reach` are in units of `unit` mm.
template <typename Undistort>
void fit_distortion(const Undistort& undistort, double reach, double unit, Lens& lens) noexcept {
  Terms terms(node_count, 2);
  Values wanted(node_count);
  for (int i = 0; i < node_count; ++i) {
    const double fraction = chebyshev_node(i, node_count);
    const double distorted = reach * fraction;
    const Undistorted undistorted = undistort(distorted);
    // An error of the factor moves the distorted point by this weight times the error.
    const double weight = distorted * undistorted.slope;
    const double squared = fraction * fraction;
    terms(i, 0) = weight * squared;
    terms(i, 1) = weight * squared * squared;
    wanted[i] = weight * (undistorted.radius / distorted - 1);
  }
  const Unknowns k = least_squares(terms, wanted);
  const double mm = reach * unit;
  lens.k1 = k[0] / (mm * mm);
  lens.k2 = k[1] / (mm * mm) / (mm * mm);
}

/// The largest error of the distorted radius in pixels, of which there are `pixels` per `unit`.
template <typename Undistort>
Result<double> radial_residual(const Undistort& undistort, double reach, double unit, double pixels,
                               const Lens& lens) noexcept {
  Lens centered = lens;
  centered.center_shift.setZero();
  double worst = 0;
  for (int i = 1; i <= probe_count; ++i) {
    const double wanted = reach * i / probe_count;
    const auto chip = distort(centered, Eigen::Vector2d(undistort(wanted).radius * unit, 0));
    if (!chip) return tl::unexpected(chip.error());
    worst = std::max(worst, std::abs(chip->x() / unit - wanted));
  }
  if (!std::isfinite(worst * pixels)) return tl::unexpected(CameraReason::not_finite);
  return worst * pixels;
}

/// Value and slope of 1 + c1 s + c2 s^2 + c3 s^3.
ValueAndSlope cubic(const std::array<double, 3>& c, double s) noexcept {
  return {1 + s * (c[0] + s * (c[1] + s * c[2])), c[0] + s * (2 * c[1] + s * 3 * c[2])};
}

/// The undistorted radius and its slope over the distorted one, mm; none at a pole of the distortion.
std::optional<ValueAndSlope> undistorted(const Undistortion& distortion, double r) noexcept {
  const ValueAndSlope n = cubic(distortion.numerator, r * r), d = cubic(distortion.denominator, r * r);
  if (!(d.value > 0)) return std::nullopt;
  const double factor = n.value / d.value;
  return ValueAndSlope{r * factor, factor + 2 * r * r * (n.slope - factor * d.slope) / d.value};
}

/// The displacement of `pixel` by p1 and p2, in pixels; `pixel` is the position without them.
double tangential_at(const View& view, const Eigen::Vector2d& pixel) noexcept {
  const Eigen::Vector2d distorted = view.lens.on_image(pixel);
  const double radius = distorted.norm();
  if (radius == 0) return 0;
  const double undistorted = view.inverse.undistorted_radius(std::min(radius, view.reach));
  const Eigen::Vector2d added = view.lens.tangential(distorted * (undistorted / radius));
  return std::hypot(view.lens.fx * added.x(), view.lens.fy * added.y());
}

/// The displacement increases along every ray from the axis, so that the largest is at the border.
double worst_tangential(const View& view, const Raster& raster) noexcept {
  if (view.lens.is_radial()) return 0;
  double worst = 0;
  for (int i = 0; i <= border_points; ++i) {
    const double u = raster.width * i / border_points - 0.5;
    const double v = raster.height * i / border_points - 0.5;
    worst = std::max({worst, tangential_at(view, {u, -0.5}), tangential_at(view, {u, raster.height - 0.5}),
                      tangential_at(view, {-0.5, v}), tangential_at(view, {raster.width - 0.5, v})});
  }
  return worst;
}

bool has_radial_terms(const RadialModel& radial) noexcept {
  return std::any_of(radial.k.begin(), radial.k.end(), [](double k) { return k != 0; });
}

}  // namespace

Result<FittedLens> fit_lens(const std::array<double, 9>& k, const std::vector<double>& d,
                            const wire::CameraConstants& constants) noexcept {
  if (const auto checked = check(constants); !checked) return tl::unexpected(checked.error());
  const Result<OpenCvLens> opencv = opencv_lens(k, d);
  if (!opencv) return tl::unexpected(opencv.error());
  const Raster raster = raster_of(constants);
  FittedLens fitted;
  fitted.lens.image_distance = opencv->fx / raster.mx;
  fitted.lens.center_shift = -to_chip(raster, {opencv->cx, opencv->cy});
  const double reach = image_reach(fitted.lens, raster) / fitted.lens.image_distance;
  const double farthest_row = std::max(std::abs(-0.5 - opencv->cy), std::abs(raster.height - 0.5 - opencv->cy));
  fitted.aspect = std::abs(1 - raster.my * fitted.lens.image_distance / opencv->fy) * farthest_row;
  if (!std::isfinite(reach) || !(reach > 0) || !std::isfinite(fitted.aspect)) {
    return tl::unexpected(CameraReason::bad_calibration);
  }
  const Result<LensInverse> inverse = LensInverse::over(*opencv, reach);
  if (!inverse) return tl::unexpected(inverse.error());
  const View view{*opencv, *inverse, reach};
  fitted.tangential = worst_tangential(view, raster);
  if (!has_radial_terms(opencv->radial)) return fitted;
  const double unit = fitted.lens.image_distance;
  const auto undistort = [&view](double distorted) {
    const double radius = view.inverse.undistorted_radius(distorted);
    return Undistorted{radius, view.lens.radial.distorted(radius).slope};
  };
  fit_distortion(undistort, reach, unit, fitted.lens);
  if (monotonic_radius(fitted.lens) < reach * unit) return tl::unexpected(CameraReason::not_monotonic);
  const double pixels = std::max(view.lens.fx, view.lens.fy);
  const Result<double> residual = radial_residual(undistort, reach, unit, pixels, fitted.lens);
  if (!residual) return tl::unexpected(residual.error());
  fitted.residual = *residual;
  return fitted;
}

Result<FittedLens> fit_lens(const Lens& lens, const Undistortion& distortion,
                            const wire::CameraConstants& constants) noexcept {
  if (const auto checked = check(constants); !checked) return tl::unexpected(checked.error());
  if (!(lens.image_distance > 0)) return tl::unexpected(CameraReason::bad_field_of_view);
  const Raster raster = raster_of(constants);
  const double reach = image_reach(lens, raster);
  for (int i = 1; i <= probe_count; ++i) {
    const auto at = undistorted(distortion, reach * i / probe_count);
    if (!at || !(at->slope > 0) || !std::isfinite(at->value)) return tl::unexpected(CameraReason::not_monotonic);
  }
  const auto undistort = [&distortion](double distorted) {
    const auto at = undistorted(distortion, distorted);
    return at ? Undistorted{at->value, 1 / at->slope} : Undistorted{};
  };
  FittedLens fitted;
  fitted.lens = lens;
  fit_distortion(undistort, reach, 1, fitted.lens);
  if (!(monotonic_radius(fitted.lens) >= reach)) return tl::unexpected(CameraReason::not_monotonic);
  const double pixels = std::max(raster.mx, raster.my);
  const Result<double> residual = radial_residual(undistort, reach, 1, pixels, fitted.lens);
  if (!residual) return tl::unexpected(residual.error());
  fitted.residual = *residual;
  return fitted;
}

}  // namespace trk_bridge::camera
