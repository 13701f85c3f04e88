// Between the thread that receives and the one that draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include <ros/time.h>
#include <boost/shared_ptr.hpp>

namespace trk_bridge::rviz_display {

/// What has arrived since it was last asked for.
template <typename Message>
struct Arrivals {
  std::vector<boost::shared_ptr<const Message>> messages;  ///< in the order of arrival
  std::uint64_t count = 0;                                 ///< of them, those included that were dropped
  ros::Time last;                                          ///< ROS time of the last one's arrival
};

/// Holds `most` messages: while nobody draws (a dialogue is open) the oldest are dropped. Safe from any thread.
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

  Arrivals<Message> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(arrivals_, {});
  }

 private:
  std::mutex mutex_;
  Arrivals<Message> arrivals_;
};

}  // namespace trk_bridge::rviz_display
