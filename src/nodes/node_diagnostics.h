// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Publishes the statuses of a node on /diagnostics periodically.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "bridge/ros_report.h"
#include "bridge/status.h"
#include "master_watch.h"
#include "status_reporter.h"

namespace trk_bridge::nodes {

/// Statuses are named `<name>: <subject>` and published from the callback queue of `node`, whose thread calls their
/// functions. The last one, about ROS itself, is the same in all nodes.
class NodeDiagnostics {
 public:
  NodeDiagnostics(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name);

  void add(const std::string& subject, std::function<bridge::Status()> describe);
  /// Call after all statuses are added.
  void start();

 private:
  bridge::Status describe_ros();

  ::ros::NodeHandle node_;
  diagnostic_updater::Updater updater_;
  MasterWatch master_;
  std::int64_t ros_time_ = 0, ros_time_moved_ = 0;  // see RosReport
  StatusReporter<bridge::RosReport> ros_reporter_;
  ::ros::WallTimer timer_;
};

}  // namespace trk_bridge::nodes
