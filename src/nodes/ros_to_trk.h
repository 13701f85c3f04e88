// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// ROS topics and tf to trk endpoints; shared by the node and the nodelet.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "bridge/departures.h"
#include "live_services.h"
#include "node_diagnostics.h"
#include "sent_topic.h"
#include "sink_output.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// Runs from construction to destruction. Diagnostics are published from the callback queue of `node`.
class RosToTrk {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`; `name` is the full name of the node
  /// or nodelet. Throws ParameterError and TransportError. If a recording or a segment cannot be opened, nothing is
  /// thrown: diagnostics report it.
  RosToTrk(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name);

 private:
  /// Services `set_delay` and `set_lead`.
  void advertise_services(::ros::NodeHandle);
  /// Applies delay and lead of `form_` to all paced destinations that do not set their own.
  Answer change_timing();

  std::vector<transport::SinkForm> own_forms_;  // of the destinations, as their URLs set it
  transport::SinkForm form_;                    // defaults for them; for the thread of the callbacks
  SinkOutputs sinks_;
  std::optional<SentTopic> sent_;
  std::optional<bridge::Departures> departures_;
  std::unique_ptr<TrkInput> input_;
  std::vector<::ros::ServiceServer> services_;
  NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::nodes
