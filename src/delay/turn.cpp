// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "turn.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace trk_bridge::delay {
namespace {

constexpr std::size_t fewest_points = 8;
constexpr int rounds = 10;
constexpr double finest = 0.05;  // pixels: points are not found more accurately

/// Position of a point in front of the lens (x right and z up at y = 1, halfway between both frames), and its motion.
struct Seen {
  Eigen::Vector2d place, moved;
};

/// Motion of a point per radian of pan, tilt and roll, and for a zoom by a factor of e, to first order. At the midpoint
/// of both positions the second order is zero.
Eigen::Matrix<double, 2, 4> motions_at(const Eigen::Vector2d& place) {
  const double u = place.x(), v = place.y();
  Eigen::Matrix<double, 2, 4> motions;
  motions << 1 + u * u, -u * v, -v, u,  //
      u * v, -(1 + v * v), u, v;
  return motions;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Turn turn_between(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) noexcept {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(before.transpose() * now));
  const Eigen::Vector3d about = turn.angle() * turn.axis();
  return {about.z(), about.x(), about.y()};
}

std::optional<Turn> turn_of(const std::vector<MovedPoint>& points, const camera::Lens& lens,
                            const camera::Raster& raster) {
  if (points.size() < fewest_points) return std::nullopt;
  const auto before_lens = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    return (camera::undistort(lens, camera::to_chip(raster, pixel)) + lens.center_shift) / lens.image_distance;
  };
  std::vector<Seen> seen;
  std::vector<double> right, up;
  for (const auto& point : points) {
    const Eigen::Vector2d before = before_lens(point.before), now = before_lens(point.now);
    seen.push_back({(before + now) / 2, now - before});
    right.push_back(seen.back().moved.x());
    up.push_back(seen.back().moved.y());
  }
  // Least squares with Tukey's weights, which ignore points that move differently.
  const double pixel = 1 / (raster.mx * lens.image_distance);
  Eigen::Vector4d turn(median(right), -median(up), 0, 0);
  std::vector<double> errors(seen.size());
  std::size_t agreeing = 0;
  for (int round = 0; round < rounds; ++round) {
    std::transform(seen.begin(), seen.end(), errors.begin(),
                   [&](const Seen& one) { return (one.moved - motions_at(one.place) * turn).norm(); });
    // 4 standard deviations of the errors of points that agree.
    const double reach = 4.7 * std::max(median(errors) / 1.18, finest * pixel);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right_side = Eigen::Vector4d::Zero();
    agreeing = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double part = errors[i] / reach;
      if (!(part < 1)) continue;
      ++agreeing;
      const double weight = (1 - part * part) * (1 - part * part);
      const auto motions = motions_at(seen[i].place);
      normal += weight * motions.transpose() * motions;
      right_side += weight * motions.transpose() * seen[i].moved;
    }
    turn = normal.ldlt().solve(right_side);
  }
  if (agreeing < fewest_points || 2 * agreeing < seen.size() || !turn.allFinite()) return std::nullopt;
  return Turn(turn.head<3>());
}

}  // namespace trk_bridge::delay
