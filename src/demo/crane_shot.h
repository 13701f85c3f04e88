// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Moves the example crane: joint states, and the lens of its camera.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/JointState.h>
#include <trk_bridge/CameraParams.h>

#include "nodes/node_diagnostics.h"
#include "trk_bridge/camera/calibration.h"

namespace trk_bridge::demo {

/// Publishes `joint_states`, `camera_info` (frame_id: parameter `optical_frame`) and `lens` from its own thread, with
/// one stamp for all messages of a cycle. The pose in `lens` is the origin, because the pose is known from joints and
/// tf only.
class CraneShot {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`: `rate` (Hz, 1..1000, default 50),
  /// `joints` (`shot`, or `external`: another node publishes joint states, this one only the lens) and `optical_frame`
  /// (default camera_optical). Throws ParameterError.
  CraneShot(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name);
  ~CraneShot();
  CraneShot(const CraneShot&) = delete;
  CraneShot& operator=(const CraneShot&) = delete;

 private:
  void run();
  void publish(double seconds);

  double rate_;
  bool moves_joints_;
  ::ros::Publisher joint_states_, camera_infos_, lenses_;
  sensor_msgs::JointState joint_state_;
  sensor_msgs::CameraInfo camera_info_;
  trk_bridge::CameraParams lens_;
  camera::Calibrator calibrator_;
  nodes::NodeDiagnostics diagnostics_;

  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopped_ = false;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace trk_bridge::demo
