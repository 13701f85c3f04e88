// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "numeric.h"
#include "params.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera {
namespace {

using wire::has;

/// Cosine of tilt below which pan and roll are treated as one rotation. The error of this is at most twice this number.
constexpr double gimbal_lock = 1e-10;

struct SinCos {
  double sin, cos;
};

/// Exact at multiples of 90 degrees, and accurate after any number of turns.
SinCos sin_cos_of_degrees(double degrees) noexcept {
  // Both steps are exact. Not std::remquo(): qemu's i386 gives no quotient.
  const double within_turn = std::remainder(degrees, 360.0);
  const int quarter_turns = static_cast<int>(std::lrint(within_turn / 90.0));
  const double rest = (within_turn - quarter_turns * 90.0) / degrees_per_radian;
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (static_cast<unsigned>(quarter_turns) & 3U) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// In (-180, 180], never -0.
double degrees_of(double sin, double cos) noexcept {
  const double degrees = std::atan2(sin, cos) * degrees_per_radian;
  return degrees <= -180.0 ? 180.0 : degrees + 0.0;
}

Eigen::Vector3d to_y_up(const Eigen::Vector3d& z_up) noexcept { return {z_up.x(), z_up.z(), -z_up.y()}; }
Eigen::Vector3d from_y_up(const Eigen::Vector3d& y_up) noexcept { return {y_up.x(), -y_up.z(), y_up.y()}; }

/// Rotates z-up coordinates to the axes of a format.
Eigen::Matrix3d axes(bool y_up) noexcept {
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
  if (y_up) a << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return a;
}

/// The nearest rotation to a matrix that is a rotation to 1e-3, by Newton's iteration for the polar decomposition. Each
/// step squares the error and halves it.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) noexcept {
  constexpr int steps_from_1e_3_to_the_last_digit = 3;
  Eigen::Matrix3d rotation = m;
  for (int i = 0; i < steps_from_1e_3_to_the_last_digit; ++i) {
    rotation = (0.5 * (rotation + rotation.inverse().transpose())).eval();
  }
  return rotation;
}

Eigen::Isometry3d isometry(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) noexcept {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = translation;
  return pose;
}

bool finite(const wire::Euler& e) noexcept {
  return std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z) && std::isfinite(e.pan) &&
         std::isfinite(e.tilt) && std::isfinite(e.roll);
}

/// The options that the numbers of a pose depend on: formats with the same ones write a pose in the same way.
std::uint32_t pose_options(std::uint32_t format) noexcept {
  const std::uint32_t matrix_options = wire::studio_to_camera | wire::camera_y_up;
  return format & (wire::euler | wire::studio_y_up | (has(format, wire::euler) ? 0U : matrix_options));
}

Eigen::Vector3d position_of(const wire::CameraParams& params) noexcept {
  const Eigen::Vector3d position(params.euler.x, params.euler.y, params.euler.z);
  return has(params.format, wire::studio_y_up) ? from_y_up(position) : position;
}

void set_position(const Eigen::Vector3d& position, wire::CameraParams& params) noexcept {
  const Eigen::Vector3d written = has(params.format, wire::studio_y_up) ? to_y_up(position) : position;
  params.euler.x = written.x() + 0.0;
  params.euler.y = written.y() + 0.0;
  params.euler.z = written.z() + 0.0;
}

Result<Eigen::Isometry3d> decode_matrix(const wire::CameraParams& params) noexcept {
  const Eigen::Map<const Eigen::Matrix4d> matrix(params.matrix.data());
  if (!matrix.allFinite()) return tl::unexpected(CameraReason::not_finite);
  if (!wire::is_rigid(params.matrix)) return tl::unexpected(CameraReason::not_a_rotation);
  Eigen::Isometry3d m = isometry(nearest_rotation(matrix.topLeftCorner<3, 3>()), matrix.topRightCorner<3, 1>());
  if (has(params.format, wire::studio_to_camera)) m = m.inverse();
  const Eigen::Matrix3d studio = axes(has(params.format, wire::studio_y_up));
  const Eigen::Matrix3d camera = axes(has(params.format, wire::camera_y_up));
  const Eigen::Isometry3d pose =
      isometry(studio.transpose() * m.linear() * camera, studio.transpose() * m.translation());
  if (!pose.matrix().allFinite()) return tl::unexpected(CameraReason::not_finite);
  return pose;
}

Result<void> encode_matrix(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept {
  const Eigen::Matrix3d studio = axes(has(params.format, wire::studio_y_up));
  const Eigen::Matrix3d camera = axes(has(params.format, wire::camera_y_up));
  Eigen::Isometry3d m = isometry(studio * pose.linear() * camera.transpose(), studio * pose.translation());
  if (has(params.format, wire::studio_to_camera)) m = m.inverse();
  if (!m.matrix().allFinite()) return tl::unexpected(CameraReason::not_finite);
  Eigen::Map<Eigen::Matrix4d>(params.matrix.data()) = (m.matrix().array() + 0.0).matrix();
  return {};
}

}  // namespace

PanTiltRoll pan_tilt_roll(const Eigen::Matrix3d& rotation) noexcept {
  const Eigen::Vector3d forward = rotation.col(1);
  const double cos_tilt = std::hypot(forward.x(), forward.y());
  PanTiltRoll angles;
  angles.tilt = degrees_of(forward.z(), cos_tilt);
  if (cos_tilt < gimbal_lock) {
    angles.pan = degrees_of(rotation(1, 0), rotation(0, 0));
    return angles;
  }
  angles.pan = degrees_of(-forward.x(), forward.y());
  // Roll is computed relative to this pan: close to gimbal lock, pan is noise, and roll compensates it.
  const Eigen::Vector3d level_right(forward.y() / cos_tilt, -forward.x() / cos_tilt, 0);
  angles.roll = degrees_of(level_right.dot(rotation.col(2)), level_right.dot(rotation.col(0)));
  return angles;
}

Eigen::Matrix3d rotation_of(const PanTiltRoll& angles) noexcept {
  const auto [sp, cp] = sin_cos_of_degrees(angles.pan);
  const auto [st, ct] = sin_cos_of_degrees(angles.tilt);
  const auto [sr, cr] = sin_cos_of_degrees(angles.roll);
  Eigen::Matrix3d pan, tilt, roll;
  pan << cp, -sp, 0, sp, cp, 0, 0, 0, 1;
  tilt << 1, 0, 0, 0, ct, -st, 0, st, ct;
  roll << cr, 0, sr, 0, 1, 0, -sr, 0, cr;
  return pan * tilt * roll;
}

Result<Eigen::Isometry3d> decode_pose(const wire::CameraParams& params) noexcept {
  if (!has(params.format, wire::euler)) return decode_matrix(params);
  if (!finite(params.euler)) return tl::unexpected(CameraReason::not_finite);
  return isometry(rotation_of({params.euler.pan, params.euler.tilt, params.euler.roll}), position_of(params));
}

Result<void> encode_pose(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept {
  if (!pose.matrix().allFinite()) return tl::unexpected(CameraReason::not_finite);
  std::array<double, 16> columns;
  Eigen::Map<Eigen::Matrix4d>(columns.data()) = pose.matrix();
  if (!wire::is_rigid(columns)) return tl::unexpected(CameraReason::not_a_rotation);
  if (!has(params.format, wire::euler)) return encode_matrix(pose, params);
  set_position(pose.translation(), params);
  const PanTiltRoll angles = pan_tilt_roll(pose.linear());
  params.euler.pan = angles.pan;
  params.euler.tilt = angles.tilt;
  params.euler.roll = angles.roll;
  return {};
}

Result<void> convert_pose(const wire::CameraParams& params, const Result<Eigen::Isometry3d>& pose,
                          wire::CameraParams& out) noexcept {
  if (pose_options(params.format) == pose_options(out.format)) {
    out.matrix = params.matrix;
    out.euler = params.euler;
    return {};
  }
  if (!pose) return tl::unexpected(pose.error());
  if (!has(params.format & out.format, wire::euler)) return encode_pose(*pose, out);
  out.euler = params.euler;
  set_position(pose->translation(), out);
  return {};
}

}  // namespace trk_bridge::camera
