// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/calibration.h"

#include <algorithm>
#include <cmath>

#include "radial_fit.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera {
namespace {

Result<void> check_lens(const Lens& lens) noexcept {
  if (!std::isfinite(lens.image_distance) || !lens.center_shift.allFinite() || !std::isfinite(lens.k1) ||
      !std::isfinite(lens.k2)) {
    return tl::unexpected(CameraReason::not_finite);
  }
  if (!(lens.image_distance > 0)) return tl::unexpected(CameraReason::bad_field_of_view);
  return {};
}

std::array<double, 8> in_opencv_order(const RadialModel& radial) noexcept {
  const auto& k = radial.k;
  return {k[0], k[1], 0, 0, k[2], k[3], k[4], k[5]};
}

/// Converts coefficients for radii in units of `from` to units of `to`.
std::array<double, 8> rescaled(std::array<double, 8> d, double from, double to) noexcept {
  const double square = (to / from) * (to / from);
  const std::array<double, 8> factor = {
      square, square * square, 1, 1, square * square * square, square, square * square, square * square * square};
  std::transform(d.begin(), d.end(), factor.begin(), d.begin(), [](double k, double f) { return k == 0 ? k : k * f; });
  return d;
}

}  // namespace

const char* name(DistortionModel model) noexcept {
  return model == DistortionModel::plumb_bob ? "plumb_bob" : "rational_polynomial";
}

std::array<double, 9> camera_matrix(const Lens& lens, const wire::CameraConstants& constants) noexcept {
  const Raster raster = raster_of(constants);
  const Eigen::Vector2d axis = to_pixel(raster, -lens.center_shift);
  return {raster.mx * lens.image_distance, 0, axis.x(), 0, raster.my * lens.image_distance, axis.y(), 0, 0, 1};
}

Result<Calibrator::Fit> Calibrator::fit(const Key& key) const noexcept {
  const double squared = key.reach * key.reach;
  const double undistorted_reach = key.reach * (1 + squared * (key.k1 + squared * key.k2));
  const double unit = undistorted_reach * undistorted_reach;
  const double pixels = key.pixels_per_mm * undistorted_reach;
  const auto fitted =
      fit_radial(key.k1 * unit, key.k2 * unit * unit, key.reach / undistorted_reach, tolerance_ / pixels);
  if (!fitted) return tl::unexpected(fitted.error());
  return Fit{key, undistorted_reach, {fitted->model, in_opencv_order(fitted->radial), fitted->residual * pixels}};
}

Result<Calibration> Calibrator::calibrate(const Lens& lens, const wire::CameraConstants& constants) noexcept {
  if (const auto checked = check(constants); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_lens(lens); !checked) return tl::unexpected(checked.error());
  const Raster raster = raster_of(constants);
  const Key key{lens.k1, lens.k2, image_reach(lens, raster), std::max(raster.mx, raster.my)};
  const bool kept = fit_ && fit_->key.k1 == key.k1 && fit_->key.k2 == key.k2 && fit_->key.reach == key.reach &&
                    fit_->key.pixels_per_mm == key.pixels_per_mm;
  if (!kept) {
    if (monotonic_radius(lens) < key.reach) return tl::unexpected(CameraReason::not_monotonic);
    ++fits_;
    const Result<Fit> fitted = fit(key);
    if (!fitted) return tl::unexpected(fitted.error());
    fit_ = *fitted;
  }
  Calibration calibration;
  calibration.width = static_cast<std::uint32_t>(constants.image_width);
  calibration.height = static_cast<std::uint32_t>(constants.image_height);
  calibration.k = camera_matrix(lens, constants);
  // An image distance of almost 0 can be 0 pixels.
  if (!(calibration.k[0] > 0 && calibration.k[4] > 0)) return tl::unexpected(CameraReason::bad_field_of_view);
  calibration.distortion = fit_->distortion;
  calibration.distortion.d = rescaled(fit_->distortion.d, fit_->undistorted_reach, lens.image_distance);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(calibration.k.begin(), calibration.k.end(), finite) ||
      !std::all_of(calibration.distortion.d.begin(), calibration.distortion.d.end(), finite) ||
      !finite(calibration.distortion.residual)) {
    return tl::unexpected(CameraReason::no_fit);
  }
  return calibration;
}

}  // namespace trk_bridge::camera
