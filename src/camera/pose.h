// Poses from and to the transform of a parameter record.
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Writes `matrix` or `euler` of `params` as `params.format` says; the other one is not touched. Refuses
/// (not_a_rotation, not_finite) what is not a pose.
[[nodiscard]] Result<void> encode_pose(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept;

/// The pose of `params` in the format of `out`: the very doubles where the options that they depend on agree, the very
/// angles from Euler to Euler. `pose` is decode_pose(params).
[[nodiscard]] Result<void> convert_pose(const wire::CameraParams& params, const Result<Eigen::Isometry3d>& pose,
                                        wire::CameraParams& out) noexcept;

}  // namespace trk_bridge::camera
