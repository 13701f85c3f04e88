#include "ros_to_trk.h"

#include "node.h"
#include "params_input.h"
#include "ros/ros_to_trk_parameters.h"
#include "tf_input.h"

namespace trk_bridge::nodes {

RosToTrk::RosToTrk(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name)
    : diagnostics_(node, private_node, name) {
  const auto parameters = read_parameters(private_node, [&](const auto& tree) {
    return ros1::read_ros_to_trk_parameters(tree, camera_name_of(node.getNamespace()));
  });
  for (const auto& sink : parameters.sinks) sinks_.add(sink, parameters.form);
  const auto write_all = [this](const bridge::OutgoingSet& set) { sinks_.write(set); };
  if (parameters.input == ros1::OutgoingInput::tf) {
    input_ = std::make_unique<TfInput>(node, parameters, write_all);
  } else {
    input_ = std::make_unique<ParamsInput>(node, parameters, write_all);
  }
  diagnostics_.add(parameters.name, [this] { return input_->describe(); });
  for (const auto& sink : sinks_.all()) {
    diagnostics_.add(sink->url(), [one = sink.get()] { return one->describe(); });
  }
  diagnostics_.start();
}

}  // namespace trk_bridge::nodes
