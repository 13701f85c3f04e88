// When a sample was valid, as a ROS time that tf can live with.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include <ros/time.h>

namespace trk_bridge::ros1 {

/// Nanoseconds since 1970 UTC as a ROS time; none outside of what that can hold (1970 to 2106) and for 0, which ROS
/// takes for "no time".
[[nodiscard]] std::optional<::ros::Time> to_time(std::int64_t nanoseconds) noexcept;

/// Stamps of one camera: arrival less the tracking system's delay, strictly increasing whatever the clock does. Where
/// the clock stands or steps back, stamps go on by `least_step` from the newest one until it has caught up.
/// Not synchronised, never allocates.
class Stamper {
 public:
  /// Apart still when a stamp is taken for a double of seconds (2.4e-7 s near today's date).
  static constexpr std::int64_t least_step = 1000;

  explicit Stamper(std::chrono::nanoseconds delay) noexcept : delay_(delay.count()) {}

  /// `arrival` in nanoseconds since 1970 UTC. None when no ROS time can tell it.
  [[nodiscard]] std::optional<::ros::Time> stamp(std::int64_t arrival) noexcept;

  /// Stamps that could not be arrival less delay.
  std::uint64_t held() const noexcept { return held_; }
  /// How far the last stamp is ahead of its arrival less delay, nanoseconds; 0 in order.
  std::int64_t ahead() const noexcept { return ahead_; }

 private:
  std::int64_t delay_;
  std::int64_t newest_ = 0;
  std::uint64_t held_ = 0;
  std::int64_t ahead_ = 0;
};

}  // namespace trk_bridge::ros1
