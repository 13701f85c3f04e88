// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "params_input.h"

#include "base/clock.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

ParamsInput::ParamsInput(::ros::NodeHandle node, const ros1::RosToTrkParameters& parameters, SetWriter write)
    : write_(std::move(write)), sets_(parameters.constants), reporter_(parameters.name) {
  statistics_.store(sets_.statistics());
  const auto queue = static_cast<std::uint32_t>(parameters.queue_size);
  constants_ = node.subscribe<trk_bridge::CameraConstants>(
      "constants", queue, [this](const trk_bridge::CameraConstantsConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay());
  params_ = node.subscribe<trk_bridge::CameraParams>(
      "params", queue, [this](const trk_bridge::CameraParamsConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay());
}

void ParamsInput::receive(const trk_bridge::CameraConstants& message) {
  sets_.use(ros1::from_msg(message));
  statistics_.store(sets_.statistics());
}

void ParamsInput::receive(const trk_bridge::CameraParams& message) {
  auto set = sets_.use(ros1::from_msg(message), base::steady_now());
  set.time = ros1::from_time(message.header.stamp);
  write_(set);
  statistics_.store(sets_.statistics());
}

bridge::Status ParamsInput::describe() {
  return reporter_.status({statistics_.load(), params_.getTopic(), base::steady_now()});
}

}  // namespace trk_bridge::nodes
