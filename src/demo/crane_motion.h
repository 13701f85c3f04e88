// The shot that the example crane (urdf/crane.urdf) repeats: its joints and its lens as functions of time.
#pragma once

#include <array>

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::demo {

/// Names of the joints that move by themselves, in the order of Moment::joints. The mount's level follows the arm.
inline constexpr std::array joint_names{"column_pan", "arm_elevation", "arm_extension",
                                        "head_pan",   "head_tilt",     "head_roll"};

/// The crane at one time of its shot.
struct Moment {
  std::array<double, joint_names.size()> joints{};  ///< rad, and m of arm_extension, as in the URDF
  camera::Lens lens;
  Eigen::Vector3d target;  ///< m in the studio: what the head keeps in the middle of the picture, and in focus
};

/// Seconds after which the shot begins again where it began, at rest.
inline constexpr double shot_duration = 40;

/// Any finite time. Position, direction and lens are continuous, and so are their velocities and accelerations.
Moment moment_at(double seconds) noexcept;

/// The crane's camera: 1920 x 1080 pixels on a chip of 9.59 mm x 5.39 mm, no blanks.
wire::CameraConstants camera_constants() noexcept;

}  // namespace trk_bridge::demo
