// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "published_camera.h"

#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraParams.h>

#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::test {

sensor_msgs::CameraInfo camera_info_of(const TrackedCamera& camera) {
  const auto& c = camera.constants;
  const auto& p = camera.params;
  const double mx = c.image_width / c.chip_width, my = c.image_height / c.chip_height;
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(c.image_width);
  info.height = static_cast<std::uint32_t>(c.image_height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {mx * p.fov, 0,          c.image_width / 2.0 - mx * p.center_x - 0.5,
            0,          my * p.fov, c.image_height / 2.0 + my * p.center_y - 0.5,
            0,          0,          1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {info.K[0], 0, info.K[2], 0, 0, info.K[4], info.K[5], 0, 0, 0, 1, 0};
  return info;
}

geometry_msgs::TransformStamped transform_of(const TrackedCamera& camera, const std::string& name) {
  Eigen::Matrix3d optical;
  optical << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  Eigen::Isometry3d camera_T_optical = Eigen::Isometry3d::Identity();
  camera_T_optical.linear() = optical;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "studio";
  transform.child_frame_id = name + "_optical";
  transform.transform = ros1::to_transform(pose_of(camera) * camera_T_optical);
  return transform;
}

PublishedCamera::PublishedCamera(const std::string& name, const TrackedCamera& camera, double rate)
    : name_(name), camera_(camera) {
  ::ros::NodeHandle ros;
  infos_ = ros.advertise<sensor_msgs::CameraInfo>(info_topic(), 100);
  params_ = ros.advertise<trk_bridge::CameraParams>(params_topic(), 100);
  transforms_ = ros.advertise<tf2_msgs::TFMessage>("/tf", 100);
  publishing_ = std::make_unique<Repeating>(rate, [this] { publish(); });
}

void PublishedCamera::is(const TrackedCamera& camera) {
  const std::lock_guard lock(mutex_);
  camera_ = camera;
}

void PublishedCamera::publishes(const Parts& parts) {
  const std::lock_guard lock(mutex_);
  parts_ = parts;
}

void PublishedCamera::spoils(const Change& change) {
  const std::lock_guard lock(mutex_);
  change_ = change;
}

void PublishedCamera::publish() {
  const std::lock_guard lock(mutex_);
  const auto stamp = ::ros::Time::now();
  camera_.params.counter = ++counter_;
  if (parts_.transform) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform_of(camera_, name_));
    message.transforms.back().header.stamp = stamp;
    transforms_.publish(message);
  }
  if (parts_.camera_info) {
    auto info = camera_info_of(camera_);
    info.header.stamp = stamp;
    info.header.frame_id = name_ + "_optical";
    if (change_) change_(info);
    infos_.publish(info);
  }
  if (parts_.params) {
    trk_bridge::CameraParams message;
    message.header.stamp = stamp;
    message.header.frame_id = "studio";
    ros1::to_msg(camera_.params, message);
    params_.publish(message);
  }
}

}  // namespace trk_bridge::test
