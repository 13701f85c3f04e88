// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_info.h"

#include <algorithm>

namespace trk_bridge::ros1 {

void from_msg(const sensor_msgs::CameraInfo& message, bridge::CameraInfo& info) {
  info.width = message.width;
  info.height = message.height;
  info.distortion_model = message.distortion_model;
  info.d = message.D;
  std::copy(message.K.begin(), message.K.end(), info.k.begin());
}

bridge::CameraInfo from_msg(const sensor_msgs::CameraInfo& message) {
  bridge::CameraInfo info;
  from_msg(message, info);
  return info;
}

}  // namespace trk_bridge::ros1
