// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The messages of a camera, made from the updates of its pipeline.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/LensEncoders.h>
#include <trk_bridge/TimeCode.h>

#include "bridge/camera_pipeline.h"
#include "message_pool.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {

/// Not synchronised. Does not allocate per sample, unless subscribers in the same process keep many messages (see
/// MessagePool).
class CameraMessages {
 public:
  explicit CameraMessages(const CameraFrames&);

  /// Makes messages of everything in an update, with its stamp; the other messages stay unchanged.
  void make(const bridge::CameraUpdate&);
  /// Makes only the CameraInfo of an update, which must have a calibration.
  void make_camera_info(const bridge::CameraUpdate&);

  /// For publishing; they must not be changed.
  const auto& params() const noexcept { return params_.current(); }
  const auto& constants() const noexcept { return constants_.current(); }
  const auto& camera_info() const noexcept { return camera_info_.current(); }
  const auto& time_code() const noexcept { return time_code_.current(); }
  const auto& lens_encoders() const noexcept { return lens_encoders_.current(); }
  const geometry_msgs::TransformStamped& transform() const noexcept { return transform_; }

 private:
  MessagePool<trk_bridge::CameraParams> params_;
  MessagePool<trk_bridge::CameraConstants> constants_;
  MessagePool<sensor_msgs::CameraInfo> camera_info_;
  MessagePool<trk_bridge::TimeCode> time_code_;
  MessagePool<trk_bridge::LensEncoders> lens_encoders_;
  geometry_msgs::TransformStamped transform_;
};

}  // namespace trk_bridge::ros1
