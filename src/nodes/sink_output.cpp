// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "sink_output.h"

#include <iostream>

#include <ros/console.h>
#include <ros/init.h>

#include "base/clock.h"

namespace trk_bridge::nodes {
namespace {

bridge::OutletOptions options_for(const transport::SinkForm& form) {
  bridge::OutletOptions options;
  options.defaults = form;
  options.feed = bridge::Feed::one_camera;
  return options;
}

/// Works also after ROS and its log have shut down.
void log_error(const std::string& text) {
  if (::ros::ok()) {
    ROS_ERROR_STREAM(text);
  } else {
    std::cerr << "[ERROR] " << text << std::endl;
  }
}

}  // namespace

SinkOutput::SinkOutput(const transport::SinkEndpoint& endpoint, const transport::SinkForm& form)
    : outlet_(endpoint, options_for(form)), reporter_(outlet_.name()) {}

SinkOutput::~SinkOutput() {
  if (const auto closed = outlet_.close(); !closed) {
    const auto lost = outlet_.unwritten();
    log_error(outlet_.name() + " was not closed in order: " + transport::describe(closed.error()) +
              (lost > 0 ? "; " + std::to_string(lost) + " queued records are lost" : ""));
  }
}

bridge::Status SinkOutput::describe(const std::optional<bridge::DepartureStatistics>& departures) {
  return reporter_.status(bridge::report_of(outlet_, departures, base::steady_now()));
}

SinkOutputs::~SinkOutputs() {
  for (const auto& sink : sinks_) sink->finish();
}

}  // namespace trk_bridge::nodes
