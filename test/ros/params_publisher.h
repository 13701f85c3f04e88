// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The input of ros_to_trk, as from another node.
#pragma once

#include <cstdint>
#include <string>

#include <ros/node_handle.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::test {

/// Publishes what a node receives with `input: params`.
class ParamsPublisher {
 public:
  explicit ParamsPublisher(const std::string& name_space)
      : params_(::ros::NodeHandle().advertise<trk_bridge::CameraParams>(name_space + "/params", 10000)),
        constants_(::ros::NodeHandle().advertise<trk_bridge::CameraConstants>(name_space + "/constants", 10,
                                                                              /*latch=*/true)) {}

  bool has_subscribers() const { return params_.getNumSubscribers() > 0 && constants_.getNumSubscribers() > 0; }
  void publish(const wire::CameraParams& record, const ::ros::Time& stamp = {}) const {
    trk_bridge::CameraParams message;
    ros1::to_msg(record, message);
    message.header.stamp = stamp;
    params_.publish(message);
  }
  void publish(const wire::CameraConstants& record) const {
    trk_bridge::CameraConstants message;
    ros1::to_msg(record, message);
    constants_.publish(message);
  }

 private:
  ::ros::Publisher params_, constants_;
};

}  // namespace trk_bridge::test
