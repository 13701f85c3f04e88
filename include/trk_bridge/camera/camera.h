// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The canonical camera, converted from and to parameter records of any format (doc/conventions.md). Both frames are
// z-up, the pose is camera to studio, image distance and shift on the chip are in mm, blanks are considered.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <tl/expected.hpp>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::camera {

/// Why there is no camera, lens or image point, or why it cannot be written in a format.
enum class CameraReason : std::uint8_t {
  not_finite,         ///< a number is NaN or infinite
  not_a_rotation,     ///< the matrix is not orthonormal to 1e-3, is a reflection, or its bottom row is not 0 0 0 1
  constants_needed,   ///< the format cannot be read or written without constants, and none are known
  bad_constants,      ///< sizes of image, chip or blanks that leave no picture
  bad_field_of_view,  ///< an angle outside 0..180 degrees, or an image distance that is not positive
  bad_format,         ///< a format to be written has unknown bits, or both vertical and diagonal
  not_monotonic,      ///< k1, k2 fold the image: no inverse in the range that is used
  behind_camera,      ///< the point is not in front of the camera
  no_fit,             ///< no distortion model with finite coefficients can be fitted
  bad_calibration,    ///< K or D of a CameraInfo is impossible or of an unknown kind
  too_wide,           ///< the image extends too far from the optical axis to be drawn
  no_lens,            ///< the records have no lens
};

/// One line for users.
std::string describe(CameraReason);

/// Lens of the canonical camera.
struct Lens {
  double image_distance = 0;                               ///< mm, more than 0
  Eigen::Vector2d center_shift = Eigen::Vector2d::Zero();  ///< mm on the chip, x right, y up
  double k1 = 0, k2 = 0;                                   ///< mm^-2, mm^-4, distorted to undistorted
  double focdist = 0;                                      ///< m
  double aperture = 0;
};

/// Pose and lens of a camera at one moment.
struct Camera {
  /// studio_T_camera: camera axes (x right, y forward, z up) in the studio (x right, y into the studio, z up), metres.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Lens lens;
};

/// A value, or the reason for the failure.
template <typename T>
using Result = tl::expected<T, CameraReason>;

/// Whether constants are valid: sizes positive, blanks not negative and smaller than the image, all finite. The fake
/// chip is not checked: if it is invalid, it is computed.
[[nodiscard]] Result<void> check(const wire::CameraConstants&) noexcept;

/// The pose only, which needs no constants. A matrix that is a rotation to 1e-3 gives the nearest rotation.
[[nodiscard]] Result<Eigen::Isometry3d> decode_pose(const wire::CameraParams&) noexcept;
/// The lens only. `constants` may be null for image distance and considered blanks with shift on the chip.
[[nodiscard]] Result<Lens> decode_lens(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;
/// Pose and lens. `constants` may be null under the same conditions as for the lens.
[[nodiscard]] Result<Camera> decode(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;

/// The camera in `format`; id 0 and counter 0. `constants` may be null under the same conditions.
[[nodiscard]] Result<wire::CameraParams> encode(const Camera&, std::uint32_t format,
                                                const wire::CameraConstants* constants) noexcept;

/// Constants to send with parameters in `format`: the fake chip is that of its aspect option. A fake chip that already
/// agrees to the digits of ASCII records (2e-5) is not changed, nor are constants that do not pass check().
[[nodiscard]] wire::CameraConstants constants_for(const wire::CameraConstants&, std::uint32_t format) noexcept;

/// Canonical Euler angles (degrees) of a rotation studio_R_camera = Rz(pan) Rx(tilt) Ry(roll): pan and roll in (-180,
/// 180], tilt in [-90, 90]; at tilt +-90 roll is 0.
struct PanTiltRoll {
  double pan = 0, tilt = 0, roll = 0;
};
/// The canonical angles of a matrix, which must be a rotation to 1e-3.
[[nodiscard]] PanTiltRoll pan_tilt_roll(const Eigen::Matrix3d& rotation) noexcept;
/// The inverse, exact at multiples of 90 degrees.
[[nodiscard]] Eigen::Matrix3d rotation_of(const PanTiltRoll&) noexcept;

}  // namespace trk_bridge::camera
