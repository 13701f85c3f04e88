// Poses from and to the transform of a parameter record.
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// The options of `format` that the numbers of a pose depend on: two formats that agree in them tell a pose alike.
std::uint32_t pose_options(std::uint32_t format) noexcept;

/// Writes `matrix` or `euler` of `params` as `params.format` says; the other one is not touched. Refuses
/// (not_a_rotation, not_finite) what is not a pose.
[[nodiscard]] Result<void> encode_pose(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept;

/// The pose of `params` as `format` tells it, into `told` whose format is already set.
[[nodiscard]] Result<void> reexpress_pose(const wire::CameraParams& params, wire::CameraParams& told) noexcept;

}  // namespace trk_bridge::camera
