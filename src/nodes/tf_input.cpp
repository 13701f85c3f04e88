// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tf_input.h"

#include <algorithm>
#include <cmath>

#include <tf2/exceptions.h>

#include "base/clock.h"
#include "ros/camera_info.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {
namespace {

/// Hz, polling rate if no tf arrives.
constexpr double default_rate = 50;

}  // namespace

TfInput::TfInput(::ros::NodeHandle node, const ros1::RosToTrkParameters& parameters, SetWriter write,
                 const SentTopic& sent)
    : write_(std::move(write)),
      parameters_(parameters),
      sent_(sent),
      period_(std::llround(1e9 / parameters.rate.value_or(default_rate))),
      transform_filter_(parameters.studio_frame, parameters.camera_frame),
      sets_(parameters.tf),
      reporter_(parameters.name),
      tf_thread_(1, &tf_queue_) {
  const auto queue = static_cast<std::uint32_t>(parameters.queue_size);
  using TfEvent = ::ros::MessageEvent<const tf2_msgs::TFMessage>;
  auto tf_node = node;
  tf_node.setCallbackQueue(&tf_queue_);
  tf_ = tf_node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      "/tf", queue, [this](const TfEvent& event) { receive(event, /*is_static=*/false); }, ::ros::VoidConstPtr(),
      no_delay());
  static_tf_ = tf_node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      "/tf_static", queue, [this](const TfEvent& event) { receive(event, /*is_static=*/true); }, ::ros::VoidConstPtr(),
      no_delay());
  camera_info_ = node.subscribe<sensor_msgs::CameraInfo>(
      "camera_info", queue, [this](const sensor_msgs::CameraInfoConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay());
  lens_ = node.subscribe<trk_bridge::CameraParams>(
      "lens", queue,
      [this](const trk_bridge::CameraParamsConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sets_.use_lens(message->focdist, message->aperture);
      },
      ::ros::VoidConstPtr(), no_delay());
  tf_thread_.start();
  thread_ = std::thread([this] { run(); });
}

TfInput::~TfInput() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
  tf_thread_.stop();
}

void TfInput::receive(const ::ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool is_static) {
  const std::string& sender = event.getPublisherName();
  const auto ros_now = ros1::from_time(::ros::Time::now());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& transform : event.getConstMessage()->transforms) {
      if (is_static) {
        transform_filter_.add_static(transform.header.frame_id, transform.child_frame_id);
      } else if (!passes(transform, sender, ros_now)) {
        continue;
      }
      transforms_.setTransform(transform, sender, is_static);
    }
    has_new_tf_ = true;
  }
  changed_.notify_all();
}

bool TfInput::passes(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                     std::int64_t ros_now) {
  if (transform_filter_.ros_time_went_back(ros_now)) start_over();
  const bridge::StampedLink link{transform.header.frame_id, transform.child_frame_id,
                                 ros1::from_time(transform.header.stamp), sender};
  const auto verdict = transform_filter_.classify(link, ros_now, base::steady_now());
  if (verdict == bridge::TransformFilter::Verdict::restart) start_over();
  return verdict != bridge::TransformFilter::Verdict::refuse;
}

void TfInput::start_over() {
  transforms_.clear();
  sets_.restart();
}

void TfInput::receive(const sensor_msgs::CameraInfo& message) {
  const auto info = ros1::from_msg(message);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sets_.use(info, ros1::from_time(message.header.stamp), base::steady_now());
  }
  changed_.notify_all();
}

void TfInput::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_) {
    changed_.wait_for(lock, period_, [this] { return stopping_ || has_new_tf_; });
    has_new_tf_ = false;
    if (!stopping_) process_newest_pose(lock);
  }
}

TfInput::Pose TfInput::newest_pose() const {
  try {
    return transforms_.lookupTransform(parameters_.studio_frame, parameters_.camera_frame, ::ros::Time(0));
  } catch (const tf2::TransformException& error) {
    return tl::unexpected(std::string(error.what()));
  }
}

bool TfInput::is_due(bool is_static, std::int64_t now) {
  // Only static poses are limited here if Departures has a timer or there is no rate.
  if (!is_static && (parameters_.pace || !parameters_.rate)) return true;
  // Slightly early poses are accepted, so that none is lost if tf arrives at this rate.
  if (now < due_ - period_.count() / 4) return false;
  due_ = std::max(due_, now) + period_.count();
  return true;
}

void TfInput::process_newest_pose(std::unique_lock<std::mutex>& lock) {
  const auto ros_now = ros1::from_time(::ros::Time::now());
  const auto pose = newest_pose();
  pose_fault_ = pose ? std::string() : pose.error();
  if (!pose) return;
  const auto stamp = ros1::from_time(pose->header.stamp);
  last_pose_ = stamp;
  if (!sets_.is_new(stamp) || !is_due(stamp == 0, base::steady_now())) return;
  ahead_ = stamp == 0 || ros_now == 0 ? 0 : stamp - ros_now;
  const auto restarts = transform_filter_.statistics().restarts;
  // tf and camera_info of the same time arrive on different connections.
  changed_.wait_for(lock, period_ / 4, [&] { return stopping_ || !sets_.expects_lens(stamp); });
  if (stopping_ || restarts != transform_filter_.statistics().restarts) return;
  const auto set = sets_.make(ros1::to_isometry(pose->transform), stamp, base::steady_now());
  if (!set) return;
  lock.unlock();
  write_(*set);
  lock.lock();
}

bridge::Status TfInput::describe() {
  bridge::TfReport report;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    report.tf = sets_.statistics();
    // Counts the sets that were sent, not those that the input passed on.
    const auto sent = sent_.statistics();
    report.tf.sets = sent.sets;
    report.tf.last_set = sent.last;
    report.tf.last_stamp = sent.last_stamp;
    report.pose_fault = pose_fault_;
    report.filter = transform_filter_.statistics();
    report.last_pose = last_pose_;
    report.ahead = ahead_;
  }
  report.info_topic = camera_info_.getTopic();
  report.time = base::steady_now();
  return reporter_.status(std::move(report), parameters_.rate.value_or(default_rate));
}

}  // namespace trk_bridge::nodes
