// How a camera turned between two moments: as its picture shows it, and as its poses say it.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "picture_motion.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::delay {

/// Rotation about the camera's own axes, radians, in the signs of the protocol: pan to the left, tilt up, roll
/// clockwise seen from behind. In this order: pan, tilt, roll.
using Turn = Eigen::Vector3d;

/// The value in the middle; 0 for none.
double median(std::vector<double> values);

/// Between two rotations studio_R_camera.
[[nodiscard]] Turn turn_between(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) noexcept;

/// The turn that makes most of the points move as they do, seen through this lens. A zoom between both frames is taken
/// out; travel is not. `points` are in pixels of `raster`. None where fewer than half of the points agree, or too few.
[[nodiscard]] std::optional<Turn> turn_of(const std::vector<MovedPoint>& points, const camera::Lens&,
                                          const camera::Raster& raster);

}  // namespace trk_bridge::delay
