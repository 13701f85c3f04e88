// A thread that reads one source and hands every record to the cameras that want it.
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

/// Reads from start() until it is destroyed, the source ends or fails. A source that failed stays so: its diagnostics
/// say why, and the node lives on for its other sources. What arrives together, of different cameras, is published
/// together: one message of tf, then the cameras' own messages, then what needs a fit of their lenses.
class SourceReader {
 public:
  /// The cameras must outlive this and be fed by nobody else. `tf` is the topic of the cameras' transforms.
  SourceReader(std::unique_ptr<transport::Source> source, std::vector<CameraOutput*> cameras,
               const ::ros::Publisher& tf);
  ~SourceReader();
  SourceReader(const SourceReader&) = delete;
  SourceReader& operator=(const SourceReader&) = delete;

  void start();

  /// How it stands at this moment, but for the cameras' part. Any thread.
  bridge::CameraReport report() const;

 private:
  void run();
  void read();
  void dispatch(const transport::Sample&);
  /// All that is ready.
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
  std::string failure_;  // of the thread itself
  std::thread thread_;
};

}  // namespace trk_bridge::nodes
