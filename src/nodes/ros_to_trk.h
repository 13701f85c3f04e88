// ROS topics and tf to trk endpoints: what the node and the nodelet share.
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

/// Runs from construction to destruction. Diagnostics go out from the callback queue of `node`.
class RosToTrk {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`; `name` is the node's or nodelet's
  /// full name. Throws ParameterError and TransportError; a recording or a segment that cannot be opened is no error
  /// here but in the diagnostics.
  RosToTrk(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name);

 private:
  /// Services `set_delay` and `set_lead`.
  void advertise_services(::ros::NodeHandle);
  /// Gives `form_` to what a timer sends and has no delay or lead of its own; the answer says to how many.
  Answer change_timing();

  std::vector<transport::SinkForm> own_forms_;  // of the destinations, as far as they say something
  transport::SinkForm form_;                    // for those that do not; of the thread of the callbacks
  SinkOutputs sinks_;
  std::optional<SentTopic> sent_;
  std::optional<bridge::Departures> departures_;
  std::unique_ptr<TrkInput> input_;
  std::vector<::ros::ServiceServer> services_;
  NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::nodes
