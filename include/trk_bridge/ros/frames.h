// Frames and signs on the ROS side: the one place that knows both.
//
// The namespace is not called ros: generated messages live in trk_bridge and mean the outer one when they say ros.
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

/// Where nothing else is given: `studio`, the camera's name, the name and "_optical".
CameraFrames default_frames(const std::string& camera_name);

/// A pose as tf has it: translation in m and a unit quaternion with w >= 0, so that equal rotations give equal
/// messages. With `studio_T_camera` it is the transform of parent studio frame and child camera frame; both are z-up
/// as REP 103 wants them up, the camera looking along its y axis.
geometry_msgs::Transform to_transform(const Eigen::Isometry3d& parent_T_child);

/// The way back. The quaternion is normalised; it must not be zero.
Eigen::Isometry3d to_isometry(const geometry_msgs::Transform&);

/// The optical frame (REP 103, suffix `_optical`: x right, y down, z forward) in the camera frame (x right, y forward,
/// z up). No translation.
Eigen::Isometry3d camera_T_optical();

/// The same as the static transform of tf.
geometry_msgs::TransformStamped optical_transform(const CameraFrames&, const ::ros::Time& stamp);

}  // namespace trk_bridge::ros1
