// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Services that change options of a running node.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/SetBool.h>
#include <trk_bridge/SetSeconds.h>

#include "ros/parameter_reader.h"

namespace trk_bridge::nodes {

/// The response of a service: success, or the reason of the failure.
struct Answer {
  bool success = false;
  std::string message;
};

/// A service of type trk_bridge/SetSeconds that refuses numbers outside the range. `change` is called in the thread of
/// the node's callbacks.
inline ::ros::ServiceServer advertise_seconds(::ros::NodeHandle& node, const std::string& name,
                                              const ros1::Range& range, std::function<Answer(double)> change) {
  using Service = trk_bridge::SetSeconds;
  return node.advertiseService<Service::Request, Service::Response>(
      name, [name, range, change = std::move(change)](Service::Request& request, Service::Response& response) {
        Answer answer{false, name + " = " + ros1::shown(request.seconds) + ": must be " + range.text()};
        if (range.contains(request.seconds)) answer = change(request.seconds);
        response.success = static_cast<std::uint8_t>(answer.success);
        response.message = answer.message;
        return true;
      });
}

/// The same with type std_srvs/SetBool.
inline ::ros::ServiceServer advertise_switch(::ros::NodeHandle& node, const std::string& name,
                                             std::function<Answer(bool)> change) {
  using Service = std_srvs::SetBool;
  return node.advertiseService<Service::Request, Service::Response>(
      name, [change = std::move(change)](Service::Request& request, Service::Response& response) {
        const Answer answer = change(request.data != 0);
        response.success = static_cast<std::uint8_t>(answer.success);
        response.message = answer.message;
        return true;
      });
}

}  // namespace trk_bridge::nodes
