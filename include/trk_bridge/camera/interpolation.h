// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Interpolation of cameras between two samples.
#pragma once

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// The camera of a record in numbers that can be interpolated with those of another record of the same format and
/// constants. The constants need not be known: an angle of view becomes the image distance divided by the side that the
/// angle refers to, and the centre shift is as in the record. Errors: those of decode_pose, not_finite and
/// bad_field_of_view for the lens, and bad_format for a format that encode_relative() cannot write.
[[nodiscard]] Result<Camera> decode_relative(const wire::CameraParams&) noexcept;
/// The inverse; id 0 and counter 0.
[[nodiscard]] Result<wire::CameraParams> encode_relative(const Camera&, std::uint32_t format) noexcept;

/// `part` is 0 at `a` and 1 at `b`; values outside of that range extrapolate. Every number is linear, including the
/// image distance (and so the focal length in every format).
[[nodiscard]] Lens interpolate(const Lens& a, const Lens& b, double part) noexcept;
/// Slerp along the shorter arc.
[[nodiscard]] Eigen::Matrix3d interpolate(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double part) noexcept;
/// Linear.
[[nodiscard]] inline Eigen::Vector3d interpolate(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 double part) noexcept {
  return a + part * (b - a);
}

}  // namespace trk_bridge::camera
