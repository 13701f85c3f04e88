// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Input of ros_to_trk from the topics `params` and `constants`.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "bridge/outgoing_diagnostics.h"
#include "ros/ros_to_trk_parameters.h"
#include "status_reporter.h"
#include "trk_bridge/base/snapshot.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// Writes in the callbacks of the topics, which are called by one thread at a time.
class ParamsInput : public TrkInput {
 public:
  /// Subscribes in the namespace of `node`.
  ParamsInput(::ros::NodeHandle node, const ros1::RosToTrkParameters&, SetWriter);

  bridge::Status describe() override;

 private:
  void receive(const trk_bridge::CameraParams&);
  void receive(const trk_bridge::CameraConstants&);

  SetWriter write_;
  bridge::ParamsToTrk sets_;
  base::Snapshot<bridge::ParamsToTrkStatistics> statistics_;
  StatusReporter<bridge::ParamsReport> reporter_;
  ::ros::Subscriber constants_, params_;
};

}  // namespace trk_bridge::nodes
