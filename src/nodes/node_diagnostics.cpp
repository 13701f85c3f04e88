// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "node_diagnostics.h"

#include <utility>

#include <ros/master.h>
#include <ros/time.h>

#include "base/clock.h"
#include "ros/diagnostics.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

NodeDiagnostics::NodeDiagnostics(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node,
                                 const std::string& name)
    : node_(node), updater_(node, private_node, name), ros_time_moved_(base::steady_now()), ros_reporter_(name) {
  updater_.setHardwareID("trk");
}

void NodeDiagnostics::add(const std::string& subject, std::function<bridge::Status()> describe) {
  updater_.add(subject, [describe = std::move(describe)](diagnostic_updater::DiagnosticStatusWrapper& status) {
    ros1::to_msg(describe(), status);
  });
}

void NodeDiagnostics::start() {
  add("ROS", [this] { return describe_ros(); });
  timer_ = node_.createWallTimer(::ros::WallDuration(updater_.getPeriod()),
                                 [this](const ::ros::WallTimerEvent&) { updater_.force_update(); });
}

bridge::Status NodeDiagnostics::describe_ros() {
  bridge::RosReport report;
  report.time = base::steady_now();
  report.master = master_.state();
  report.master_uri = ::ros::master::getURI();
  report.answered = master_.answered();
  report.is_simulated = ::ros::Time::isSimTime();
  report.ros_time = ros1::from_time(::ros::Time::now());
  if (report.ros_time != ros_time_) ros_time_moved_ = report.time;
  ros_time_ = report.ros_time;
  report.ros_time_moved = ros_time_moved_;
  return ros_reporter_.status(std::move(report));
}

}  // namespace trk_bridge::nodes
