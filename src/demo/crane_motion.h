// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The shot of the example crane (urdf/crane.urdf): its joints and its lens as functions of time.
#pragma once

#include <array>

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::demo {

/// Names of the joints that are driven, in the order of Moment::joints. The level of the mount follows the arm.
inline constexpr std::array joint_names{"column_pan", "arm_elevation", "arm_extension",
                                        "head_pan",   "head_tilt",     "head_roll"};

/// The crane at one time of its shot.
struct Moment {
  std::array<double, joint_names.size()> joints{};  ///< rad, arm_extension: m, as in the URDF
  camera::Lens lens;
  Eigen::Vector3d target;  ///< m in the studio: the point that the head keeps centred and in focus
};

/// s; then the shot starts again from the same position, at rest.
inline constexpr double shot_duration = 40;

/// `seconds` can be any finite time. Position, direction and lens are continuous, as are their velocities and
/// accelerations.
Moment moment_at(double seconds) noexcept;

/// The camera of the crane: 1920 x 1080 pixels on a chip of 9.59 mm x 5.39 mm, no blanks.
wire::CameraConstants camera_constants() noexcept;

}  // namespace trk_bridge::demo
