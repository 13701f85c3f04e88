// A camera's messages, from the updates of its pipeline.
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

/// Not synchronised. A sample allocates nothing, unless subscribers in the same process keep many of its messages (see
/// MessagePool).
class CameraMessages {
 public:
  explicit CameraMessages(const CameraFrames&);

  /// Makes the messages of all that is in an update, with its stamp; the others stay as they are.
  void make(const bridge::CameraUpdate&);
  /// The CameraInfo of an update alone, which must have a calibration.
  void make_camera_info(const bridge::CameraUpdate&);

  /// To be published as they are, not to be changed any more.
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
