// Sets from tf and the topics `camera_info` and `lens`.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include <ros/callback_queue.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraParams.h>
#include <tl/expected.hpp>

#include "bridge/outgoing_diagnostics.h"
#include "bridge/transform_gate.h"
#include "ros/ros_to_trk_parameters.h"
#include "status_reporter.h"
#include "trk_bridge/camera/converter.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// A thread of its own looks at tf at the rate of the parameters, by the steady clock and without drift, and writes a
/// set when there is a newer pose; one that is late is written as soon as it is there.
/// tf is received by another thread, through a gate: stamps that are wrong, and clocks that are set, cost less than 1
/// s. The set is published on the topic `sent` as well, in the node's own form and stamped with the time of its pose:
/// trk has no times, so that only the counter tells a receiver's pose from the next.
class TfInput : public TrkInput {
 public:
  /// Subscribes in the namespace of `node`.
  TfInput(::ros::NodeHandle node, const ros1::RosToTrkParameters&, SetWriter);
  ~TfInput() override;

  bridge::Status describe() override;

 private:
  using Clock = std::chrono::steady_clock;
  using Pose = tl::expected<geometry_msgs::TransformStamped, std::string>;

  void run();
  /// False when the input is to end before.
  bool wait_until(Clock::time_point);
  /// Writes a set when there is a newer pose. False when there is a pose, but the newest is known already.
  bool look();
  Pose newest_pose() const;
  void receive(const ::ros::MessageEvent<const tf2_msgs::TFMessage>&, bool is_static);
  /// Whether the transform may go into `transforms_`, which is emptied before where a clock was set. `ros_now` in ns.
  bool passes(const geometry_msgs::TransformStamped&, const std::string& sender, std::int64_t ros_now);
  void start_over();
  void receive(const sensor_msgs::CameraInfo&);
  void publish(const bridge::OutgoingSet&, const std_msgs::Header&);

  SetWriter write_;
  const ros1::RosToTrkParameters parameters_;
  const Clock::duration period_;

  mutable std::mutex mutex_;  // of all between here and the next comment
  std::condition_variable changed_;
  bool stopping_ = false;
  tf2::BufferCore transforms_;
  bridge::TransformGate gate_;
  bridge::TfToTrk sets_;
  std::string pose_fault_ = "not looked yet";
  std::int64_t last_pose_ = 0, ahead_ = 0;

  StatusReporter<bridge::TfReport> reporter_;  // of the diagnostics

  // of the thread
  camera::Converter sent_form_;
  trk_bridge::CameraParams sent_message_;

  std::thread thread_;
  ::ros::CallbackQueue tf_queue_;
  ::ros::Subscriber tf_, static_tf_, camera_info_, lens_;
  ::ros::Publisher sent_;
  ::ros::AsyncSpinner tf_thread_;
};

}  // namespace trk_bridge::nodes
