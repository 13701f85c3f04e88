#pragma once

#include <cmath>

namespace trk_bridge::camera {

inline constexpr double degrees_per_radian = 180.0 / M_PI;

}  // namespace trk_bridge::camera
