// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures the delay between a camera's video and its tracking live; shared by the node and the nodelet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "bridge/status.h"
#include "delay/meter.h"
#include "node_diagnostics.h"
#include "ros/delay_meter_parameters.h"

namespace trk_bridge::nodes {

/// Compares `image` with `params` and `constants` over the newest `window` seconds, once a second. Diagnostics show the
/// last result; the delay (std_msgs/Float64, s, positive: the video is later) is published on `~delay`, once a second
/// if the camera moved enough. Runs from construction to destruction; all callbacks are called from one thread.
class DelayMeter {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`. Throws ParameterError.
  DelayMeter(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name);
  DelayMeter(const DelayMeter&) = delete;
  DelayMeter& operator=(const DelayMeter&) = delete;

 private:
  /// Statistics of a topic.
  struct Input {
    std::string topic;
    std::uint64_t received = 0, refused = 0;
    std::string last_refusal;

    void refuse(const std::string& why);
  };

  void receive(const trk_bridge::CameraConstants&);
  void receive(const trk_bridge::CameraParams&);
  void receive(const sensor_msgs::Image&);
  void measure();
  bridge::Status describe() const;
  double field(const delay::Measurement&) const;

  ros1::DelayMeterParameters parameters_;
  delay::Meter meter_;
  Input params_, images_;
  delay::Measurement now_;
  std::optional<delay::Measurement> found_;  // the last one with a delay
  std::int64_t found_at_ = 0;                // steady clock, ns
  std::int64_t due_ = 0;                     // the next measurement; steady clock, ns

  ::ros::Publisher delay_;
  ::ros::Subscriber constants_subscriber_, params_subscriber_;
  image_transport::Subscriber image_subscriber_;
  ::ros::WallTimer timer_;
  NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::nodes
