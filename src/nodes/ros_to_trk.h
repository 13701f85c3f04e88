// ROS topics and tf to trk endpoints: what the node and the nodelet share.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <ros/node_handle.h>

#include "bridge/departures.h"
#include "node_diagnostics.h"
#include "sent_topic.h"
#include "sink_output.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// Runs from construction to destruction. Diagnostics go out from the callback queue of `node`.
class RosToTrk {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`; `name` is the node's or nodelet's
  /// full name. Throws ParameterError and TransportError; a recording or a segment that cannot be opened is no error
  /// here but in the diagnostics.
  RosToTrk(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name);

 private:
  SinkOutputs sinks_;
  std::optional<SentTopic> sent_;
  std::optional<bridge::Departures> departures_;
  std::unique_ptr<TrkInput> input_;
  NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::nodes
