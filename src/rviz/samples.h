// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The messages of one topic: a queue from the receiving to the drawing thread, and the recent messages.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include <ros/time.h>
#include <boost/shared_ptr.hpp>

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::rviz_display {

/// Seconds from `from` to `to`. Stamps are compared as integers, because ros::Duration overflows and throws if stamps
/// are far apart.
inline double seconds_between(const ros::Time& from, const ros::Time& to) {
  return static_cast<double>(ros1::from_time(to) - ros1::from_time(from)) * 1e-9;
}

/// The result of add().
enum class Added {
  in_time,    ///< newest, or late within the window
  restarted,  ///< its stamp is older than the window: time went back, and all earlier messages are discarded
};

/// Keeps the messages of 0.5 s, at least two (the last one of a slow camera is drawn until tf knows the next), at most
/// `most`. A zero stamp means "now": such a message replaces all others. Not synchronised.
template <typename Message>
class Samples {
 public:
  using Ptr = boost::shared_ptr<const Message>;
  static constexpr std::int64_t window = 500'000'000;  ///< ns
  static constexpr std::size_t most = 128;

  Added add(Ptr message) {
    const std::int64_t stamp = stamp_of(message);
    if (!samples_.empty()) {
      const std::int64_t newest = stamp_of(samples_.back());
      const bool restarted = stamp != 0 && newest != 0 && stamp < newest - window;
      if (restarted || stamp == 0 || newest == 0) {
        samples_.assign(1, std::move(message));
        return restarted ? Added::restarted : Added::in_time;
      }
    }
    const auto place = std::lower_bound(samples_.begin(), samples_.end(), stamp,
                                        [](const Ptr& sample, std::int64_t time) { return stamp_of(sample) < time; });
    if (place != samples_.end() && stamp_of(*place) == stamp) {
      *place = std::move(message);
    } else {
      samples_.insert(place, std::move(message));
    }
    forget_old();
    return Added::in_time;
  }

  /// The newest one for which `usable(message)` is true; null if there is none.
  template <typename Usable>
  Ptr newest(Usable usable) const {
    const auto found =
        std::find_if(samples_.rbegin(), samples_.rend(), [&](const Ptr& sample) { return usable(*sample); });
    return found == samples_.rend() ? nullptr : *found;
  }

  /// The newest; null if there is none.
  Ptr newest() const { return samples_.empty() ? nullptr : samples_.back(); }

  /// The one with exactly this stamp, else the newest before it, else the first after it; null if there is none. A zero
  /// stamp means the newest.
  Ptr belonging_to(const ros::Time& time) const {
    if (samples_.empty()) return nullptr;
    if (time.isZero()) return samples_.back();
    const auto after =
        std::upper_bound(samples_.begin(), samples_.end(), ros1::from_time(time),
                         [](std::int64_t wanted, const Ptr& sample) { return wanted < stamp_of(sample); });
    return after == samples_.begin() ? *after : *(after - 1);
  }

  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }
  std::size_t size() const { return samples_.size(); }

 private:
  static std::int64_t stamp_of(const Ptr& message) { return ros1::from_time(message->header.stamp); }

  void forget_old() {
    const std::int64_t oldest_wanted = stamp_of(samples_.back()) - window;
    auto first = samples_.begin();
    while (samples_.end() - first > 2 &&
           (stamp_of(*first) < oldest_wanted || samples_.end() - first > static_cast<std::ptrdiff_t>(most))) {
      ++first;
    }
    samples_.erase(samples_.begin(), first);
  }

  std::vector<Ptr> samples_;  // oldest first, with different stamps
};

/// Messages that have arrived since the last call.
template <typename Message>
struct Arrivals {
  std::vector<boost::shared_ptr<const Message>> messages;  ///< in order of arrival
  std::uint64_t count = 0;                                 ///< including dropped messages
  ros::Time last;                                          ///< ROS time of the last arrival
};

/// Holds `most` messages: while nothing is drawn (a dialog is open), the oldest are dropped. Thread-safe.
template <typename Message>
class Inbox {
 public:
  static constexpr std::size_t most = 256;

  void put(boost::shared_ptr<const Message> message, const ros::Time& now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (arrivals_.messages.size() >= most) {
      arrivals_.messages.erase(arrivals_.messages.begin(), arrivals_.messages.begin() + most / 2);
    }
    arrivals_.messages.push_back(std::move(message));
    ++arrivals_.count;
    arrivals_.last = now;
  }

  Arrivals<Message> collect() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(arrivals_, {});
  }

 private:
  std::mutex mutex_;
  Arrivals<Message> arrivals_;
};

}  // namespace trk_bridge::rviz_display
