// CameraInfo to lens.
#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "radial_fit.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera {
namespace {

constexpr int node_count = 64;
constexpr int probe_count = 400;
constexpr int border_points = 32;

/// D in pixels of K, inverted over the image. Radii in units of the image distance.
struct View {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  RadialModel radial;
  double p1 = 0, p2 = 0;
  double reach = 0;              ///< the farthest distorted radius
  double undistorted_reach = 0;  ///< what D makes it of

  double undistorted(double distorted) const noexcept {
    const auto excess = [this, distorted](double radius) {
      const ValueAndSlope at = radial.distorted(radius);
      return ValueAndSlope{at.value - distorted, at.slope};
    };
    return increasing_root(excess, 0, undistorted_reach, distorted / reach * undistorted_reach);
  }
};

Result<View> view_of(const std::array<double, 9>& k, const std::vector<double>& d) noexcept {
  const auto finite = [](double value) { return std::isfinite(value); };
  const bool known_size = d.empty() || d.size() == 4 || d.size() == 5 || d.size() == 8;
  const bool sound = std::all_of(k.begin(), k.end(), finite) && k[0] > 0 && k[4] > 0 && k[1] == 0 && k[3] == 0 &&
                     k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (!known_size || !sound || !std::all_of(d.begin(), d.end(), finite)) {
    return tl::unexpected(CameraReason::bad_calibration);
  }
  std::array<double, 8> all{};
  std::copy(d.begin(), d.end(), all.begin());
  View view;
  view.fx = k[0];
  view.fy = k[4];
  view.cx = k[2];
  view.cy = k[5];
  view.radial.k = {all[0], all[1], all[4], all[5], all[6], all[7]};
  view.p1 = all[2];
  view.p2 = all[3];
  return view;
}

/// How far out the undistorted image goes, watching that D rises all the way. 0 where it does not.
double undistorted_reach(const RadialModel& radial, double reach) noexcept {
  constexpr int steps = 400;
  constexpr double farthest = 50;  // times the distorted radius; no image formed by D is worth its pixels there
  const double step = reach / steps;
  for (double radius = step; radius <= farthest * reach; radius += step) {
    const ValueAndSlope at = radial.distorted(radius);
    if (!(at.slope > 0) || !radial.has_no_pole(radius)) return 0;
    if (at.value >= reach) return radius;
  }
  return 0;
}

/// k1 and k2 of `lens` by least squares of the distorted radius.
void fit_lens(const View& view, Lens& lens) noexcept {
  Eigen::Matrix<double, node_count, 2> terms;
  Eigen::Matrix<double, node_count, 1> wanted;
  for (int i = 0; i < node_count; ++i) {
    const double fraction = std::sin((i + 0.5) * (M_PI_2 / node_count));
    const double distorted = view.reach * fraction;
    const double undistorted = view.undistorted(distorted);
    // An error of the factor moves the distorted point by that much of the radius, as far as D lets it through.
    const double weight = distorted * view.radial.distorted(undistorted).slope;
    const double squared = fraction * fraction;
    terms.row(i) << weight * squared, weight * squared * squared;
    wanted[i] = weight * (undistorted / distorted - 1);
  }
  const Eigen::Vector2d k = terms.colPivHouseholderQr().solve(wanted);
  const double unit = view.reach * lens.image_distance;
  lens.k1 = k[0] / (unit * unit);
  lens.k2 = k[1] / (unit * unit) / (unit * unit);
}

Result<double> radial_residual(const View& view, const Lens& lens) noexcept {
  Lens centered = lens;
  centered.center_shift.setZero();
  double worst = 0;
  for (int i = 1; i <= probe_count; ++i) {
    const double wanted = view.reach * i / probe_count;
    const auto chip = distort(centered, Eigen::Vector2d(view.undistorted(wanted) * lens.image_distance, 0));
    if (!chip) return tl::unexpected(chip.error());
    worst = std::max(worst, std::abs(chip->x() / lens.image_distance - wanted));
  }
  return worst * std::max(view.fx, view.fy);
}

/// What p1 and p2 add to the pixel that is at `u`, `v` without them.
double tangential_at(const View& view, double u, double v) noexcept {
  const Eigen::Vector2d distorted((u - view.cx) / view.fx, (v - view.cy) / view.fy);
  const double radius = distorted.norm();
  if (radius == 0) return 0;
  const Eigen::Vector2d p = distorted * (view.undistorted(std::min(radius, view.reach)) / radius);
  const double squared = p.squaredNorm();
  const double xy = p.x() * p.y();
  return std::hypot(view.fx * (2 * view.p1 * xy + view.p2 * (squared + 2 * p.x() * p.x())),
                    view.fy * (view.p1 * (squared + 2 * p.y() * p.y()) + 2 * view.p2 * xy));
}

/// The displacement grows along every ray from the axis, so that the border has the worst.
double worst_tangential(const View& view, const Raster& raster) noexcept {
  if (view.p1 == 0 && view.p2 == 0) return 0;
  double worst = 0;
  for (int i = 0; i <= border_points; ++i) {
    const double u = raster.width * i / border_points - 0.5;
    const double v = raster.height * i / border_points - 0.5;
    worst = std::max({worst, tangential_at(view, u, -0.5), tangential_at(view, u, raster.height - 0.5),
                      tangential_at(view, -0.5, v), tangential_at(view, raster.width - 0.5, v)});
  }
  return worst;
}

bool has_radial_terms(const View& view) noexcept {
  return std::any_of(view.radial.k.begin(), view.radial.k.end(), [](double k) { return k != 0; });
}

}  // namespace

Result<FittedLens> lens_of(const std::array<double, 9>& k, const std::vector<double>& d,
                           const wire::CameraConstants& constants) noexcept {
  if (const auto sound = check(constants); !sound) return tl::unexpected(sound.error());
  Result<View> view = view_of(k, d);
  if (!view) return tl::unexpected(view.error());
  const Raster raster = raster_of(constants);
  FittedLens fitted;
  fitted.lens.image_distance = view->fx / raster.mx;
  fitted.lens.center_shift = -to_chip(raster, {view->cx, view->cy});
  view->reach = image_reach(fitted.lens, raster) / fitted.lens.image_distance;
  const double farthest_row = std::max(std::abs(-0.5 - view->cy), std::abs(raster.height - 0.5 - view->cy));
  fitted.aspect = std::abs(1 - raster.my * fitted.lens.image_distance / view->fy) * farthest_row;
  if (!std::isfinite(view->reach) || !(view->reach > 0) || !std::isfinite(fitted.aspect)) {
    return tl::unexpected(CameraReason::bad_calibration);
  }
  view->undistorted_reach = undistorted_reach(view->radial, view->reach);
  if (view->undistorted_reach == 0) return tl::unexpected(CameraReason::not_monotonic);
  fitted.tangential = worst_tangential(*view, raster);
  if (!has_radial_terms(*view)) return fitted;
  fit_lens(*view, fitted.lens);
  if (monotonic_radius(fitted.lens) < view->reach * fitted.lens.image_distance) {
    return tl::unexpected(CameraReason::not_monotonic);
  }
  const Result<double> residual = radial_residual(*view, fitted.lens);
  if (!residual) return tl::unexpected(residual.error());
  fitted.residual = *residual;
  return fitted;
}

}  // namespace trk_bridge::camera
