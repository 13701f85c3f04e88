// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "delay_meter.h"

#include <algorithm>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <ros/console.h>
#include <std_msgs/Float64.h>
#include <pluginlib/class_list_macros.hpp>

#include "base/clock.h"
#include "bridge/diagnostic_text.h"
#include "delay/report.h"
#include "mains.h"
#include "node.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {
namespace {

constexpr double period = 1;          // s between two measurements
constexpr std::uint32_t frames = 10;  // queue size

}  // namespace

DelayMeter::DelayMeter(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name)
    : parameters_(read_parameters(private_node,
                                  [&](const auto& tree) {
                                    return ros1::read_delay_meter_parameters(tree, camera_name_of(node.getNamespace()));
                                  })),
      meter_(parameters_.most_delay),
      diagnostics_(node, private_node, name) {
  if (parameters_.constants) (void)meter_.use(*parameters_.constants);
  now_ = meter_.measure();
  delay_ = ::ros::NodeHandle(private_node).advertise<std_msgs::Float64>("delay", 1, /*latch=*/true);
  constants_subscriber_ = node.subscribe<trk_bridge::CameraConstants>(
      "constants", 1, [this](const trk_bridge::CameraConstantsConstPtr& message) { receive(*message); });
  params_subscriber_ = node.subscribe<trk_bridge::CameraParams>(
      "params", static_cast<std::uint32_t>(parameters_.queue_size),
      [this](const trk_bridge::CameraParamsConstPtr& message) { receive(*message); });
  const image_transport::TransportHints hints("raw", ::ros::TransportHints(), private_node);
  image_subscriber_ = image_transport::ImageTransport(node).subscribe(
      "image", frames, [this](const sensor_msgs::ImageConstPtr& message) { receive(*message); }, {}, hints);
  params_.topic = params_subscriber_.getTopic();
  images_.topic = image_subscriber_.getTopic();
  timer_ = node.createWallTimer(::ros::WallDuration(period), [this](const ::ros::WallTimerEvent&) { measure(); });
  diagnostics_.add(parameters_.name, [this] { return describe(); });
  diagnostics_.start();
  ROS_INFO_STREAM("delay_meter: " << parameters_.name << ": waiting for pictures on " << images_.topic << ", and for "
                                  << params_.topic << " and " << constants_subscriber_.getTopic());
}

void DelayMeter::Input::refuse(const std::string& why) {
  if (refused++ == 0) ROS_WARN_STREAM("delay_meter: " << topic << ": ignored: " << why);
  last_refusal = why;
}

void DelayMeter::receive(const trk_bridge::CameraConstants& message) {
  if (meter_.use(ros1::from_msg(message)) == camera::ConstantsChange::invalid) {
    ROS_WARN_STREAM("delay_meter: invalid constants are ignored");
  }
}

void DelayMeter::receive(const trk_bridge::CameraParams& message) {
  ++params_.received;
  const auto added = meter_.add(ros1::from_time(message.header.stamp), ros1::from_msg(message));
  if (!added) params_.refuse(camera::describe(added.error()));
}

void DelayMeter::receive(const sensor_msgs::Image& message) {
  ++images_.received;
  const std::int64_t stamp = ros1::from_time(message.header.stamp);
  if (stamp == 0) return images_.refuse("it has no stamp");
  try {
    meter_.add(stamp, cv_bridge::toCvCopy(message, "mono8")->image);
  } catch (const std::exception& error) {
    images_.refuse(error.what());
  }
}

void DelayMeter::measure() {
  // On a slow machine, at least half of the time is left for receiving.
  const std::int64_t begin = base::steady_now();
  if (begin < due_) return;
  meter_.keep(parameters_.window);
  now_ = meter_.measure();
  const std::int64_t end = base::steady_now();
  due_ = end + (end - begin);
  if (now_.cannot_tell) return;
  if (!found_) ROS_INFO_STREAM("delay_meter: " << parameters_.name << ": " << delay::summary(now_, field(now_)));
  found_ = now_;
  found_at_ = base::steady_now();
  std_msgs::Float64 message;
  message.data = now_.delay;
  delay_.publish(message);
}

double DelayMeter::field(const delay::Measurement& measurement) const {
  return parameters_.field_rate ? 1 / *parameters_.field_rate : measurement.tracking_interval;
}

bridge::Status DelayMeter::describe() const {
  bridge::Status status;
  for (const Input* input : {&params_, &images_}) {
    if (input->received == 0) {
      status.level = bridge::Level::warn;
      status.message += (status.message.empty() ? "" : "; ") + ("nothing on " + input->topic);
    }
  }
  const auto& shown = found_ ? *found_ : now_;
  if (status.message.empty()) {
    status.message = delay::summary(shown, field(shown));
    for (const auto& fault : delay::faults(shown)) {
      status.level = bridge::Level::warn;
      status.message += "; " + fault;
    }
  }
  for (auto& [name, value] : delay::values(shown, field(shown))) status.add(std::move(name), std::move(value));
  if (found_) status.add("setting", delay::setting(*found_));
  status.add("age of the delay (s)", bridge::age_text(found_.has_value(), found_at_, base::steady_now()));
  status.add("now", now_.cannot_tell ? delay::describe(*now_.cannot_tell) : "measured");
  for (const Input* input : {&params_, &images_}) {
    status.add("messages of " + input->topic, input->received);
    if (input->refused == 0) continue;
    status.add("left out of " + input->topic, input->refused);
    status.add("why the last one was", input->last_refusal);
  }
  return status;
}

using DelayMeterNodelet = RunningNodelet<DelayMeter>;

int delay_meter_main(int argc, char** argv) { return node_main<DelayMeter>(argc, argv, "delay_meter"); }

}  // namespace trk_bridge::nodes

PLUGINLIB_EXPORT_CLASS(trk_bridge::nodes::DelayMeterNodelet, nodelet::Nodelet)
