// A camera crane in motion, as a function of time: what the demonstration sends when there is no studio at hand.
#pragma once

#include <Eigen/Core>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::tools {

/// Dimensions of the crane and its move. Metres in the studio (x right, y into it, z up), degrees, millimetres.
namespace crane {

inline constexpr double pivot_height = 1.5;     ///< of the arm's pivot above the studio's origin
inline constexpr double arm_length = 10.0;      ///< from the pivot to the centre of projection
inline constexpr double swing = 35.0;           ///< the arm pans this far to either side
inline constexpr double mean_elevation = 12.0;  ///< about which the arm rises and falls, so that it clears the floor
inline constexpr double lift = 15.0;            ///< and how far it does
inline constexpr double shortest_image_distance = 8.0;
inline constexpr double longest_image_distance = 80.0;

inline Eigen::Vector3d pivot() { return {0.0, 0.0, pivot_height}; }
/// What the head keeps in the middle of the picture.
inline Eigen::Vector3d target() { return {0.0, 18.0, 1.5}; }

}  // namespace crane

/// The camera `seconds` after the move began. Smooth for all times: the arm sweeps, the head holds the target level,
/// the lens zooms and follows focus, and its distortion goes from barrel when wide to a little cushion when long.
camera::Camera crane_camera(double seconds) noexcept;

/// The crane's camera: 1920 x 1080 pixels on a chip of 9.59 mm x 5.39 mm, no blanks.
wire::CameraConstants crane_constants() noexcept;

}  // namespace trk_bridge::tools
