// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Publishes the topics of one camera from its pipeline.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "bridge/camera_pipeline.h"
#include "bridge/diagnostics.h"
#include "ros/camera_messages.h"
#include "ros/markers.h"
#include "ros/trk_to_ros_parameters.h"
#include "status_reporter.h"
#include "trk_bridge/base/snapshot.h"

namespace trk_bridge::nodes {

/// Publishing is separate from processing: the transforms of several cameras are published first as one message, and
/// CameraInfo, for which the lens must be fitted, after all other messages. set() and describe() belong to the thread
/// of the node's callbacks, everything else to the thread of one reader.
class CameraOutput {
 public:
  /// Advertises `params`, `constants`, `camera_info`, `time_code` and `lens_encoders` in the namespace of `node`, and
  /// publishes the constants of the parameter, if any. `markers` is a topic shared by all cameras; it is used only if
  /// publish_markers is set.
  CameraOutput(::ros::NodeHandle node, const ros1::CameraParameters&, std::optional<double> field_rate, int queue_size,
               const ::ros::Publisher& markers);

  bool wants(const wire::Record& record) const noexcept { return pipeline_.wants(record); }
  /// Processes a sample, without calibration. `now` is the time of receipt on the steady clock, ns.
  bridge::CameraUpdate process(const transport::Sample&, std::int64_t now);
  /// Fills the messages of an update that is not empty. Those of the update before must have been published.
  void make(const bridge::CameraUpdate&);
  /// Whether there is anything to publish.
  bool is_ready() const noexcept { return is_ready_; }
  /// The transform to be published; null: none.
  const geometry_msgs::TransformStamped* transform() const noexcept;
  /// Publishes all messages except the transform and the CameraInfo.
  void publish();
  /// Makes and publishes the CameraInfo and the markers. To be called last.
  void publish_camera_info();

  /// Changes options from the next sample on. For the thread of describe().
  void set(const bridge::LiveOptions&);
  const bridge::LiveOptions& live() const noexcept { return options_; }

  /// `report` is a current report without the data of the camera, which are added here. The first finding of each kind
  /// is also logged.
  bridge::Status describe(bridge::CameraReport report);

  /// The parameters at start.
  const ros1::CameraParameters& parameters() const noexcept { return parameters_; }

 private:
  void publish_markers();

  const ros1::CameraParameters parameters_;
  bridge::CameraPipeline pipeline_;
  bridge::CameraUpdate update_;
  bool is_ready_ = false;
  ros1::CameraMessages messages_;  // of update_
  std::optional<ros1::CameraMarkers> markers_;
  double field_rate_;
  ::ros::Publisher params_, constants_, camera_info_, time_code_, lens_encoders_, marker_topic_;
  bridge::CameraOptions options_;  // with later changes; for the thread of describe()
  base::Snapshot<bridge::LiveOptions> live_;
  std::atomic<bool> is_changed_{false};
  base::Snapshot<bridge::CameraStatistics> statistics_;
  base::Snapshot<bridge::MarkerStatistics> marker_statistics_;
  StatusReporter<bridge::CameraReport> reporter_;
};

}  // namespace trk_bridge::nodes
