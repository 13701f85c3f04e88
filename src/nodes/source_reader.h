// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A thread that reads one source and passes every record to its camera.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <ros/publisher.h>
#include <tf2_msgs/TFMessage.h>

#include "bridge/diagnostics.h"
#include "camera_output.h"
#include "ros/message_pool.h"
#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::nodes {

/// Reads from start() until it is destroyed, or the source ends or fails. A failed source is not reopened: its
/// diagnostics report the reason, and the node continues with its other sources. Samples of different cameras that
/// arrive together are published together: one tf message, then the messages of the cameras, then those that need a
/// lens fit.
class SourceReader {
 public:
  /// The cameras must outlive this object, and no other reader may use them. `tf` is the topic of the transforms.
  SourceReader(std::unique_ptr<transport::Source> source, std::vector<CameraOutput*> cameras,
               const ::ros::Publisher& tf);
  ~SourceReader();
  SourceReader(const SourceReader&) = delete;
  SourceReader& operator=(const SourceReader&) = delete;

  void start();

  /// The current report, without the data of the cameras. Any thread.
  bridge::CameraReport report() const;

 private:
  void run();
  void read();
  void dispatch(const transport::Sample&);
  /// Publishes everything that is ready.
  void publish();
  void note_unknown(std::uint32_t id);

  std::unique_ptr<transport::Source> source_;
  std::vector<CameraOutput*> cameras_;
  std::vector<CameraOutput*> ready_;  // in the order of their samples
  ros1::MessagePool<tf2_msgs::TFMessage> transforms_{{}};
  ::ros::Publisher tf_;
  bridge::ReaderStatistics statistics_;
  base::Snapshot<bridge::ReaderStatistics> published_;
  mutable std::mutex failure_mutex_;
  std::string failure_;  // an exception in the thread
  std::thread thread_;
};

}  // namespace trk_bridge::nodes
