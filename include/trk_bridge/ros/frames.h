// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Frames and signs on the ROS side. They are defined only here.
//
// The namespace is not called ros: generated messages are in trk_bridge and use the global namespace ros.
#pragma once

#include <string>

#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <Eigen/Geometry>

namespace trk_bridge::ros1 {

/// Frames of a camera in tf. They must differ.
struct CameraFrames {
  std::string studio = "studio";
  std::string camera;   ///< x right, y forward, z up
  std::string optical;  ///< x right, y down, z forward (REP 103): a static child of `camera`
};

/// The defaults: `studio`, the name of the camera, and that name with "_optical".
CameraFrames default_frames(const std::string& camera_name);

/// A pose in the form of tf: translation in m and a unit quaternion with w >= 0, so that equal rotations give equal
/// messages. `studio_T_camera` becomes the transform from the camera frame (child) to the studio frame (parent). Both
/// frames are z-up, as in REP 103; the camera looks along its y axis.
geometry_msgs::Transform to_transform(const Eigen::Isometry3d& parent_T_child);

/// The inverse. The quaternion is normalised; it must not be zero.
Eigen::Isometry3d to_isometry(const geometry_msgs::Transform&);

/// The optical frame (REP 103, suffix `_optical`: x right, y down, z forward) in the camera frame (x right, y forward,
/// z up). No translation.
Eigen::Isometry3d camera_T_optical();

/// The same as a static transform for tf.
geometry_msgs::TransformStamped optical_transform(const CameraFrames&, const ::ros::Time& stamp);

}  // namespace trk_bridge::ros1
