// Sets from the topics `params` and `constants`.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "finding_log.h"
#include "ros/ros_to_trk_parameters.h"
#include "ros/outgoing_diagnostics.h"
#include "ros/params_to_trk.h"
#include "trk_bridge/base/snapshot.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// Writes within the topics' callbacks: one queue with one thread at a time serves them.
class ParamsInput : public TrkInput {
 public:
  /// Subscribes in the namespace of `node`.
  ParamsInput(::ros::NodeHandle node, const trk_bridge::ros1::RosToTrkParameters&, SetWriter);

  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) override;

 private:
  void take(const trk_bridge::CameraParams&);
  void take(const trk_bridge::CameraConstants&);

  SetWriter write_;
  const trk_bridge::ros1::OutgoingForm form_;
  trk_bridge::ros1::ParamsToTrk converter_;
  base::Snapshot<trk_bridge::ros1::ParamsToTrkStatistics> statistics_;
  trk_bridge::ros1::ParamsReport last_report_;
  FindingLog log_;
  ::ros::Subscriber constants_, params_;
};

}  // namespace trk_bridge::nodes
