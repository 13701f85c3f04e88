// A camera's messages, from the updates of its pipeline.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/TimeCode.h>

#include "bridge/camera_pipeline.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {

/// Not synchronised. Messages are kept and overwritten, so that a sample allocates nothing.
class CameraMessages {
 public:
  explicit CameraMessages(const CameraFrames&);

  /// Makes the messages of all that is in an update, with its stamp; the others stay as they are.
  void make(const bridge::CameraUpdate&);

  const trk_bridge::CameraParams& params() const noexcept { return params_; }
  const trk_bridge::CameraConstants& constants() const noexcept { return constants_; }
  const sensor_msgs::CameraInfo& camera_info() const noexcept { return camera_info_; }
  const geometry_msgs::TransformStamped& transform() const noexcept { return transform_; }
  const trk_bridge::TimeCode& time_code() const noexcept { return time_code_; }

 private:
  trk_bridge::CameraParams params_;
  trk_bridge::CameraConstants constants_;
  sensor_msgs::CameraInfo camera_info_;
  geometry_msgs::TransformStamped transform_;
  trk_bridge::TimeCode time_code_;
};

}  // namespace trk_bridge::ros1
