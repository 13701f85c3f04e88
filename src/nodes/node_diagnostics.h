// A node's statuses on /diagnostics, sent at their period also while nothing else happens.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "bridge/status.h"
#include "ros/diagnostics.h"

namespace trk_bridge::nodes {

/// Statuses are named `<name>: <subject>` and sent from the callback queue of `node`, whose thread calls their
/// functions.
class NodeDiagnostics {
 public:
  NodeDiagnostics(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name)
      : node_(node), updater_(node, private_node, name) {
    updater_.setHardwareID("trk");
  }

  void add(const std::string& subject, std::function<bridge::Status()> describe) {
    updater_.add(subject, [describe = std::move(describe)](diagnostic_updater::DiagnosticStatusWrapper& status) {
      ros1::to_msg(describe(), status);
    });
  }

  void start() {
    timer_ = node_.createWallTimer(::ros::WallDuration(updater_.getPeriod()),
                                   [this](const ::ros::WallTimerEvent&) { updater_.force_update(); });
  }

 private:
  ::ros::NodeHandle node_;
  diagnostic_updater::Updater updater_;
  ::ros::WallTimer timer_;
};

}  // namespace trk_bridge::nodes
