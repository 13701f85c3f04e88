// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "opencv_lens.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace trk_bridge::camera {
namespace {

/// The undistorted radius that D maps to `reach`; 0 if D does not increase up to there.
double undistorted_reach(const RadialModel& radial, double reach) noexcept {
  constexpr int steps = 400;
  constexpr int farthest = 50;  // times the distorted radius; farther out, an image is useless
  for (int i = 1; i <= farthest * steps; ++i) {
    const double radius = reach * i / steps;
    const ValueAndSlope at = radial.distorted(radius);
    if (!(at.slope > 0) || !radial.has_no_pole(radius)) return 0;
    if (at.value >= reach) return radius;
  }
  return 0;
}

struct PointAndSlope {
  Eigen::Vector2d point;
  Eigen::Matrix2d slope;
};

PointAndSlope distorted(const OpenCvLens& lens, const Eigen::Vector2d& p) noexcept {
  const double radius = p.norm();
  if (radius == 0) return {Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  const ValueAndSlope radial = lens.radial.distorted(radius);
  const double ratio = radial.value / radius;
  const Eigen::Vector2d outward = p / radius;
  const double mixed = 2 * (lens.p1 * p.x() + lens.p2 * p.y());
  Eigen::Matrix2d slope = (radial.slope - ratio) * outward * outward.transpose();
  slope(0, 0) += ratio + 2 * lens.p1 * p.y() + 6 * lens.p2 * p.x();
  slope(0, 1) += mixed;
  slope(1, 0) += mixed;
  slope(1, 1) += ratio + 6 * lens.p1 * p.y() + 2 * lens.p2 * p.x();
  return {ratio * p + lens.tangential(p), slope};
}

/// Whether the distortion does not fold between the axis and `p`: it would change its orientation there.
bool unfolded_up_to(const OpenCvLens& lens, const Eigen::Vector2d& p) noexcept {
  constexpr int steps = 16;
  if (!lens.radial.has_no_pole(p.norm())) return false;
  for (int i = 1; i <= steps; ++i) {
    const Eigen::Vector2d between = p * i / steps;
    if (!(distorted(lens, between).slope.determinant() > 0)) return false;
  }
  return true;
}

}  // namespace

Eigen::Vector2d OpenCvLens::on_image(const Eigen::Vector2d& pixel) const noexcept {
  return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy};
}

Eigen::Vector2d OpenCvLens::tangential(const Eigen::Vector2d& undistorted) const noexcept {
  const double squared = undistorted.squaredNorm();
  const double x = undistorted.x();
  const double y = undistorted.y();
  return {2 * p1 * x * y + p2 * (squared + 2 * x * x), p1 * (squared + 2 * y * y) + 2 * p2 * x * y};
}

Result<OpenCvLens> opencv_lens(const std::array<double, 9>& k, const std::vector<double>& d) noexcept {
  const auto finite = [](double value) { return std::isfinite(value); };
  const bool known_size = d.empty() || d.size() == 4 || d.size() == 5 || d.size() == 8;
  const bool valid = std::all_of(k.begin(), k.end(), finite) && k[0] > 0 && k[4] > 0 && k[1] == 0 && k[3] == 0 &&
                     k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (!known_size || !valid || !std::all_of(d.begin(), d.end(), finite)) {
    return tl::unexpected(CameraReason::bad_calibration);
  }
  std::array<double, 8> all{};
  std::copy(d.begin(), d.end(), all.begin());
  OpenCvLens lens;
  lens.fx = k[0];
  lens.fy = k[4];
  lens.cx = k[2];
  lens.cy = k[5];
  lens.radial.k = {all[0], all[1], all[4], all[5], all[6], all[7]};
  lens.p1 = all[2];
  lens.p2 = all[3];
  return lens;
}

Result<LensInverse> LensInverse::over(const OpenCvLens& lens, double reach) noexcept {
  const double undistorted = undistorted_reach(lens.radial, reach);
  if (undistorted == 0) return tl::unexpected(CameraReason::not_monotonic);
  return LensInverse(lens, reach, undistorted);
}

double LensInverse::undistorted_radius(double distorted) const noexcept {
  const auto excess = [this, distorted](double radius) {
    const ValueAndSlope at = lens_.radial.distorted(radius);
    return ValueAndSlope{at.value - distorted, at.slope};
  };
  return increasing_root(excess, 0, undistorted_reach_, distorted / reach_ * undistorted_reach_);
}

Result<Eigen::Vector2d> LensInverse::undistorted(const Eigen::Vector2d& wanted) const noexcept {
  constexpr int steps = 20;
  constexpr double next_to_it = 1e-10;  // relative to the point: the next Newton step would be below the last digit
  const double radius = wanted.norm();
  if (radius == 0) return wanted;
  Eigen::Vector2d p = wanted * (undistorted_radius(std::min(radius, reach_)) / radius);
  if (lens_.is_radial()) return p;
  for (int i = 0; i < steps; ++i) {
    const PointAndSlope at = distorted(lens_, p);
    if (!(at.slope.determinant() > 0)) break;
    const Eigen::Vector2d step = at.slope.inverse() * (wanted - at.point);
    p += step;
    if (step.norm() > next_to_it * p.norm()) continue;
    if (!unfolded_up_to(lens_, p)) break;
    return p;
  }
  return tl::unexpected(CameraReason::not_monotonic);
}

}  // namespace trk_bridge::camera
