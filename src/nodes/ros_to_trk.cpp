// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros_to_trk.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "mains.h"
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
  form_ = parameters.form;
  for (const auto& sink : parameters.sinks) {
    sinks_.add(sink, parameters.form);
    own_forms_.push_back(sink.form);
  }
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
    own_forms_.emplace_back();
    destinations.push_back({bridge::timing_of(parameters.form),
                            parameters.pace,
                            [this](const auto& record, const auto& time) { sent_->write(record, time.nanoseconds); },
                            {}});
  }
  bridge::DepartureOptions options;
  // Without pace, the input limits the rate.
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
  advertise_services(private_node);
  diagnostics_.start();
}

void RosToTrk::advertise_services(::ros::NodeHandle node) {
  const auto nanoseconds = [](double seconds) { return std::llround(seconds * 1e9); };
  services_.push_back(advertise_seconds(node, "set_delay", ros1::sink_delay_range, [this, nanoseconds](double seconds) {
    form_.delay = transport::Delay{nanoseconds(seconds), nanoseconds(seconds), nanoseconds(seconds)};
    return change_timing();
  }));
  services_.push_back(advertise_seconds(node, "set_lead", ros1::sink_lead_range, [this, nanoseconds](double seconds) {
    form_.lead = nanoseconds(seconds);
    return change_timing();
  }));
}

Answer RosToTrk::change_timing() {
  std::size_t paced = 0;
  for (std::size_t i = 0; i < own_forms_.size(); ++i) {
    const auto timing = bridge::timing_of(transport::with_defaults(own_forms_[i], form_));
    if (departures_->set_timing(i, timing)) ++paced;
  }
  if (paced == 0) return {false, "no timer sends to any sink: start the node with pace, a delay or a lead"};
  const auto text = [](std::int64_t nanoseconds) { return ros1::shown(static_cast<double>(nanoseconds) / 1e9) + " s"; };
  const auto timing = bridge::timing_of(form_);
  return {true, "delay " + text(timing.delay.position) + ", lead " + text(timing.lead) +
                    ", for all sinks that a timer sends to, except where their URL sets it"};
}

int ros_to_trk_main(int argc, char** argv) { return node_main<RosToTrk>(argc, argv, "ros_to_trk"); }

}  // namespace trk_bridge::nodes
