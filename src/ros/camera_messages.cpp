// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_messages.h"

#include <cstring>
#include <string>

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::ros1 {
namespace {

sensor_msgs::CameraInfo camera_info_in(const std::string& frame) {
  auto message = in_frame<sensor_msgs::CameraInfo>(frame);
  // Reserves memory for the longer of both models, which copies of the message keep: then a change of the lens does not
  // allocate.
  message.distortion_model = camera::name(camera::DistortionModel::rational_polynomial);
  message.D.resize(8);
  return message;
}

/// Converts `value` into an unused message of the pool.
template <typename Value, typename Message>
void fill(MessagePool<Message>& pool, const Value& value, const ::ros::Time& stamp) {
  auto& message = pool.renew();
  to_msg(value, message);
  message.header.stamp = stamp;
}

}  // namespace

CameraMessages::CameraMessages(const CameraFrames& frames)
    : params_(in_frame<trk_bridge::CameraParams>(frames.studio)),
      constants_(in_frame<trk_bridge::CameraConstants>(frames.camera)),
      camera_info_(camera_info_in(frames.optical)),
      time_code_(in_frame<trk_bridge::TimeCode>(frames.studio)),
      lens_encoders_(in_frame<trk_bridge::LensEncoders>(frames.studio)) {
  transform_.header.frame_id = frames.studio;
  transform_.child_frame_id = frames.camera;
}

void CameraMessages::make(const bridge::CameraUpdate& update) {
  const ::ros::Time stamp = to_time(update.stamp);
  if (update.constants) fill(constants_, *update.constants, stamp);
  if (update.params) fill(params_, *update.params, stamp);
  if (update.calibration) make_camera_info(update);
  if (update.time_code) fill(time_code_, *update.time_code, stamp);
  if (update.encoders) {
    auto& message = lens_encoders_.renew();
    to_msg(update.encoders->id, update.encoders->counts, message);
    message.header.stamp = stamp;
  }
  if (update.pose) {
    transform_.transform = to_transform(*update.pose);
    transform_.header.stamp = stamp;
  }
}

void CameraMessages::make_camera_info(const bridge::CameraUpdate& update) {
  fill(camera_info_, *update.calibration, to_time(update.stamp));
}

}  // namespace trk_bridge::ros1
