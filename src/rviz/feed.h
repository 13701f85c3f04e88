// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Receives one topic of a display.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <ros/node_handle.h>

#include "camera_status.h"
#include "samples.h"

namespace trk_bridge::rviz_display {

/// collect() passes on the received messages; all functions are for one thread, messages are received in another.
template <typename Message>
class Feed {
 public:
  ~Feed() { unsubscribe(); }

  /// Discards everything received before; an empty topic subscribes to nothing. state() reports an invalid name.
  void subscribe(ros::NodeHandle& node, const std::string& topic) {
    unsubscribe();
    topic_ = topic;
    if (topic.empty()) return;
    try {
      listen(node);
    } catch (const ros::Exception& error) {
      fault_ = error.what();
    }
  }

  void unsubscribe() {
    subscriber_.shutdown();
    inbox_.reset();
    samples_.clear();
    topic_.clear();
    fault_.clear();
    received_ = 0;
  }

  /// Adds the messages that have arrived; `restarted` if any of them was.
  Added collect() {
    auto result = Added::in_time;
    if (!inbox_) return result;
    auto arrivals = inbox_->collect();
    if (arrivals.count == 0) return result;
    received_ += arrivals.count;
    last_arrival_ = arrivals.last;
    for (auto& message : arrivals.messages) {
      if (samples_.add(std::move(message)) == Added::restarted) result = Added::restarted;
    }
    return result;
  }

  /// Whether a message arrived in the last `timeout` seconds of ROS time; with 0, whether one ever arrived.
  bool alive(const ros::Time& now, double timeout) const {
    return received_ > 0 && (timeout <= 0 || seconds_between(last_arrival_, now) <= timeout);
  }

  TopicState state(const ros::Time& now, double timeout) const {
    return {topic_, fault_, received_, last_arrival_, alive(now, timeout)};
  }
  const Samples<Message>& samples() const { return samples_; }
  const std::string& topic() const { return topic_; }
  const ros::Time& last_arrival() const { return last_arrival_; }

 private:
  void listen(ros::NodeHandle& node) {
    // The callback holds a reference, too: a callback that is still running may write to an inbox that is not read any
    // more.
    const auto inbox = std::make_shared<Inbox<Message>>();
    const boost::function<void(const boost::shared_ptr<const Message>&)> put =
        [inbox](const boost::shared_ptr<const Message>& message) { inbox->put(message, ros::Time::now()); };
    subscriber_ =
        node.subscribe<Message>(topic_, queue_size, put, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    inbox_ = inbox;
  }

  static constexpr std::uint32_t queue_size = 100;

  std::string topic_, fault_;
  std::shared_ptr<Inbox<Message>> inbox_;
  ros::Subscriber subscriber_;
  Samples<Message> samples_;
  std::uint64_t received_ = 0;
  ros::Time last_arrival_;
};

}  // namespace trk_bridge::rviz_display
