// CameraInfo messages as the bridge uses them.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "bridge/camera_info.h"

namespace trk_bridge::ros1 {

/// Size, model, D and K. Header, R, P, binning and region of interest are not looked at. Allocates only when `info` is
/// new, or its model or number of coefficients changes.
void from_msg(const sensor_msgs::CameraInfo& message, bridge::CameraInfo& info);
/// The same as a new one.
bridge::CameraInfo from_msg(const sensor_msgs::CameraInfo& message);

}  // namespace trk_bridge::ros1
