// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts CameraInfo messages for the bridge.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "bridge/camera_info.h"

namespace trk_bridge::ros1 {

/// Converts size, model, D and K. Header, R, P, binning and region of interest are ignored. Allocates only if `info` is
/// new, or if its model or number of coefficients changes.
void from_msg(const sensor_msgs::CameraInfo& message, bridge::CameraInfo& info);
/// The same, as a new object.
bridge::CameraInfo from_msg(const sensor_msgs::CameraInfo& message);

}  // namespace trk_bridge::ros1
