// The canonical camera, read from and written to parameter records of any format (doc/conventions.md). z-up on both
// sides, camera to studio, image distance in mm, shift on the chip in mm, blanks considered.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <tl/expected.hpp>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::camera {

/// Why something is no camera, no lens or no picture, or cannot be written in a format.
enum class CameraReason : std::uint8_t {
  not_finite,         ///< a number is NaN or infinite
  not_a_rotation,     ///< the matrix is not orthonormal to 1e-3, is a reflection, or its bottom row is not 0 0 0 1
  constants_needed,   ///< the format cannot be understood or made without constants, and none are known
  bad_constants,      ///< constants whose image, chip or blanks leave no picture
  bad_field_of_view,  ///< an angle outside 0..180 degrees, or an image distance that is not positive
  bad_format,         ///< a format to be made has unknown bits, or vertical and diagonal at once
  not_monotonic,      ///< k1, k2 fold the image: no inverse over the range it is used in
  behind_camera,      ///< a point that is not in front of the camera has no picture
  no_fit,             ///< no distortion model can be fitted in finite numbers
  bad_calibration,    ///< K or D of a CameraInfo that no camera has, or of a kind that is not known
  too_wide,           ///< the image reaches too far off the optical axis to be drawn
  no_lens,            ///< the records have no lens
};

/// One line for a person.
std::string describe(CameraReason);

/// Lens of the canonical camera.
struct Lens {
  double image_distance = 0;                               ///< mm, more than 0
  Eigen::Vector2d center_shift = Eigen::Vector2d::Zero();  ///< mm on the chip, x right, y up
  double k1 = 0, k2 = 0;                                   ///< mm^-2, mm^-4, distorted to undistorted
  double focdist = 0;                                      ///< m
  double aperture = 0;
};

/// Where a camera is and what its lens does at one moment.
struct Camera {
  /// studio_T_camera: camera axes (x right, y forward, z up) in the studio (x right, y into it, z up), metres.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Lens lens;
};

/// A value, or the reason why there is none.
template <typename T>
using Result = tl::expected<T, CameraReason>;

/// Whether constants describe a picture: sizes positive, blanks not negative and smaller than the image, all finite.
/// The fake chip is not judged: where it is no use it is computed.
[[nodiscard]] Result<void> check(const wire::CameraConstants&) noexcept;

/// The pose alone, which needs no constants. The nearest rotation where the matrix is one to 1e-3.
[[nodiscard]] Result<Eigen::Isometry3d> decode_pose(const wire::CameraParams&) noexcept;
/// The lens alone. `constants` may be null for image distance and considered blanks with shift on the chip.
[[nodiscard]] Result<Lens> decode_lens(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;
/// Both. `constants` may be null under the same conditions as for the lens.
[[nodiscard]] Result<Camera> decode(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;

/// The camera in `format`; id 0 and counter 0. `constants` may be null under the same conditions.
[[nodiscard]] Result<wire::CameraParams> encode(const Camera&, std::uint32_t format,
                                                const wire::CameraConstants* constants) noexcept;

/// Constants to send with parameters in `format`: the fake chip agrees with its aspect option. One that agrees already
/// to the digits of ASCII records (2e-5) is left alone, as are constants that do not pass check().
[[nodiscard]] wire::CameraConstants constants_for(const wire::CameraConstants&, std::uint32_t format) noexcept;

/// Canonical Euler angles (degrees) of a rotation studio_R_camera = Rz(pan) Rx(tilt) Ry(roll): pan and roll in (-180,
/// 180], tilt in [-90, 90]; at tilt +-90 roll is 0.
struct PanTiltRoll {
  double pan = 0, tilt = 0, roll = 0;
};
/// The canonical angles of a rotation, which must be one to 1e-3.
[[nodiscard]] PanTiltRoll pan_tilt_roll(const Eigen::Matrix3d& rotation) noexcept;
/// The way back, exact at multiples of 90 degrees.
[[nodiscard]] Eigen::Matrix3d rotation_of(const PanTiltRoll&) noexcept;

}  // namespace trk_bridge::camera
