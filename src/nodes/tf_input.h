// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Input of ros_to_trk from tf and the topics `camera_info` and `lens`.
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
#include "bridge/transform_filter.h"
#include "ros/ros_to_trk_parameters.h"
#include "sent_topic.h"
#include "status_reporter.h"
#include "trk_input.h"

namespace trk_bridge::nodes {

/// Its own thread passes on every newer pose of tf when it arrives, with its lens; without pace at most at the rate. A
/// static pose is passed on at the rate. Departures decides when they are sent. Another thread receives tf through a
/// filter: after wrong stamps, or when a clock is set, less than 1 s is lost.
class TfInput : public TrkInput {
 public:
  /// Subscribes in the namespace of `node`.
  TfInput(::ros::NodeHandle node, const ros1::RosToTrkParameters&, SetWriter, const SentTopic&);
  ~TfInput() override;

  bridge::Status describe() override;

 private:
  using Pose = tl::expected<geometry_msgs::TransformStamped, std::string>;

  void run();
  /// Passes on the newest pose, if it is new.
  void process_newest_pose(std::unique_lock<std::mutex>&);
  /// Whether a pose may be passed on now without exceeding the rate. `now` is the steady clock, ns.
  bool is_due(bool is_static, std::int64_t now);
  Pose newest_pose() const;
  void receive(const ::ros::MessageEvent<const tf2_msgs::TFMessage>&, bool is_static);
  /// Whether the transform may be put into `transforms_`, which is cleared first if a clock was set. `ros_now` in ns.
  bool passes(const geometry_msgs::TransformStamped&, const std::string& sender, std::int64_t ros_now);
  void start_over();
  void receive(const sensor_msgs::CameraInfo&);

  SetWriter write_;
  const ros1::RosToTrkParameters parameters_;
  const SentTopic& sent_;
  const std::chrono::nanoseconds period_;

  mutable std::mutex mutex_;  // protects the members up to last_pose_, ahead_
  std::condition_variable changed_;
  bool stopping_ = false;
  bool has_new_tf_ = false;
  std::int64_t due_ = 0;  // steady clock, ns
  tf2::BufferCore transforms_;
  bridge::TransformFilter transform_filter_;
  bridge::TfToTrk sets_;
  std::string pose_fault_ = "not checked yet";
  std::int64_t last_pose_ = 0, ahead_ = 0;

  StatusReporter<bridge::TfReport> reporter_;  // used by the diagnostics

  std::thread thread_;
  ::ros::CallbackQueue tf_queue_;
  ::ros::Subscriber tf_, static_tf_, camera_info_, lens_;
  ::ros::AsyncSpinner tf_thread_;
};

}  // namespace trk_bridge::nodes
