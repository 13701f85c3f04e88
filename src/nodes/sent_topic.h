// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Publishes what ros_to_trk sends for tf as a topic.
#pragma once

#include <cstdint>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <trk_bridge/CameraParams.h>

#include "ros/message_pool.h"
#include "ros/ros_to_trk_parameters.h"
#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::nodes {

/// Trivially copyable.
struct SentStatistics {
  std::uint64_t sets = 0;
  std::int64_t last = 0;        ///< steady clock, ns; valid once sets > 0
  std::int64_t last_stamp = 0;  ///< of the last pose, ns since 1970; 0: none, or a static pose
};

/// The topic `sent`: each set in the form of the node's parameters, stamped with the time of its pose. trk records have
/// no time, so the counter identifies a pose at the receiver.
class SentTopic {
 public:
  /// Advertises in the namespace of `node`.
  SentTopic(::ros::NodeHandle node, const ros1::RosToTrkParameters&);

  /// One thread at a time. `time` is ns since 1970.
  void write(const wire::Record&, std::int64_t time);
  /// Any thread.
  SentStatistics statistics() const noexcept { return published_.load(); }

 private:
  const transport::SinkForm form_;
  camera::Converter converter_;
  SentStatistics statistics_;
  base::Snapshot<SentStatistics> published_;
  ros1::MessagePool<trk_bridge::CameraParams> messages_;
  ::ros::Publisher topic_;
};

}  // namespace trk_bridge::nodes
