// What goes out of tf, as a topic.
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
  std::int64_t last_stamp = 0;  ///< of the last pose, ns since 1970; 0: none or of a static pose
};

/// The topic `sent`: each set that the parameters of the node say, in its own form and stamped with the time of its
/// pose. trk has no times, so that only the counter tells a receiver's pose from the next.
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
