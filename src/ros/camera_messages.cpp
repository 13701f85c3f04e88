#include "camera_messages.h"

#include <cstring>

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::ros1 {

CameraMessages::CameraMessages(const CameraFrames& frames) {
  params_.header.frame_id = frames.studio;
  constants_.header.frame_id = frames.camera;
  camera_info_.header.frame_id = frames.optical;
  // For the longer of both models, so that a change of the lens allocates nothing.
  camera_info_.D.reserve(8);
  camera_info_.distortion_model.reserve(std::strlen(camera::name(camera::DistortionModel::rational_polynomial)));
  transform_.header.frame_id = frames.studio;
  transform_.child_frame_id = frames.camera;
  time_code_.header.frame_id = frames.studio;
}

void CameraMessages::make(const bridge::CameraUpdate& update) {
  const ::ros::Time stamp = to_time(update.stamp);
  if (update.constants) {
    to_msg(*update.constants, constants_);
    constants_.header.stamp = stamp;
  }
  if (update.params) {
    to_msg(*update.params, params_);
    params_.header.stamp = stamp;
  }
  if (update.calibration) {
    to_msg(*update.calibration, camera_info_);
    camera_info_.header.stamp = stamp;
  }
  if (update.pose) {
    transform_.transform = to_transform(*update.pose);
    transform_.header.stamp = stamp;
  }
  if (update.time_code) {
    to_msg(*update.time_code, time_code_);
    time_code_.header.stamp = stamp;
  }
}

}  // namespace trk_bridge::ros1
