// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::ros1 {

CameraFrames default_frames(const std::string& camera_name) {
  CameraFrames frames;
  frames.camera = camera_name;
  frames.optical = camera_name + "_optical";
  return frames;
}

geometry_msgs::Transform to_transform(const Eigen::Isometry3d& parent_T_child) {
  Eigen::Quaterniond q(parent_T_child.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  geometry_msgs::Transform transform;
  transform.translation.x = parent_T_child.translation().x();
  transform.translation.y = parent_T_child.translation().y();
  transform.translation.z = parent_T_child.translation().z();
  transform.rotation.x = q.x();
  transform.rotation.y = q.y();
  transform.rotation.z = q.z();
  transform.rotation.w = q.w();
  return transform;
}

Eigen::Isometry3d to_isometry(const geometry_msgs::Transform& transform) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::Quaterniond(transform.rotation.w, transform.rotation.x, transform.rotation.y, transform.rotation.z)
          .normalized()
          .toRotationMatrix();
  pose.translation() << transform.translation.x, transform.translation.y, transform.translation.z;
  return pose;
}

Eigen::Isometry3d camera_T_optical() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = Eigen::Vector3d::UnitX();
  pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
  pose.linear().col(2) = Eigen::Vector3d::UnitY();
  return pose;
}

geometry_msgs::TransformStamped optical_transform(const CameraFrames& frames, const ::ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = frames.camera;
  transform.child_frame_id = frames.optical;
  transform.transform = to_transform(camera_T_optical());
  return transform;
}

}  // namespace trk_bridge::ros1
