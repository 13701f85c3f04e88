#include "ros_to_trk.h"

#include <utility>
#include <vector>

#include "node.h"
#include "params_input.h"
#include "ros/ros_to_trk_parameters.h"
#include "tf_input.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

RosToTrk::RosToTrk(const ::ros::NodeHandle& node, const ::ros::NodeHandle& private_node, const std::string& name)
    : diagnostics_(node, private_node, name) {
  const auto parameters = read_parameters(private_node, [&](const auto& tree) {
    return ros1::read_ros_to_trk_parameters(tree, camera_name_of(node.getNamespace()));
  });
  for (const auto& sink : parameters.sinks) sinks_.add(sink, parameters.form);
  std::vector<bridge::Destination> destinations;
  for (const auto& sink : sinks_.all()) {
    destinations.push_back({bridge::timing_of(sink->form()),
                            parameters.pace,
                            [one = sink.get()](const auto& record, const auto& time) { one->write(record, time); },
                            {}});
  }
  const bool is_tf = parameters.input == ros1::OutgoingInput::tf;
  if (is_tf) {
    sent_.emplace(node, parameters);
    destinations.push_back({bridge::timing_of(parameters.form),
                            parameters.pace,
                            [this](const auto& record, const auto& time) { sent_->write(record, time.nanoseconds); },
                            {}});
  }
  bridge::DepartureOptions options;
  // On arrival, the input does not give more.
  options.rate = parameters.rate;
  options.feed = bridge::Feed::one_camera;
  options.clock = [] { return ros1::from_time(::ros::Time::now()); };
  departures_.emplace(std::move(options), std::move(destinations));
  const auto write_all = [this](const bridge::OutgoingSet& set) { departures_->write(set); };
  if (is_tf) {
    input_ = std::make_unique<TfInput>(node, parameters, write_all, *sent_);
  } else {
    input_ = std::make_unique<ParamsInput>(node, parameters, write_all);
  }
  diagnostics_.add(parameters.name, [this] { return input_->describe(); });
  for (std::size_t i = 0; i < sinks_.all().size(); ++i) {
    auto& sink = *sinks_.all()[i];
    diagnostics_.add(sink.url(), [this, &sink, i] { return sink.describe(departures_->statistics(i)); });
  }
  diagnostics_.start();
}

}  // namespace trk_bridge::nodes
