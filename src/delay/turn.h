// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The turn of a camera between two times, from its picture and from its poses.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "picture_motion.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::delay {

/// Rotation about the camera axes, radians, with the signs of the protocol: pan to the left, tilt up, roll clockwise
/// seen from behind. Order: pan, tilt, roll.
using Turn = Eigen::Vector3d;

/// The median; 0 for no values.
double median(std::vector<double> values);

/// Between two rotations studio_R_camera.
[[nodiscard]] Turn turn_between(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) noexcept;

/// The turn that explains the motion of most points, seen through this lens. A zoom between both frames is compensated,
/// translation is not. `points` are in pixels of `raster`. None if fewer than half of the points agree, or too few.
[[nodiscard]] std::optional<Turn> turn_of(const std::vector<MovedPoint>& points, const camera::Lens&,
                                          const camera::Raster& raster);

}  // namespace trk_bridge::delay
