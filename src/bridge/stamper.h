// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The time of a sample as a stamp that ROS and tf can use.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace trk_bridge::bridge {

/// The largest stamp, ns since 1970 UTC. ROS times have unsigned 32-bit seconds: they end in 2106, and 0 means "no
/// time".
inline constexpr std::int64_t latest_stamp =
    std::int64_t{std::numeric_limits<std::uint32_t>::max()} * 1'000'000'000 + 999'999'999;

/// Whether nanoseconds since 1970 UTC can be a stamp: more than 0, at most latest_stamp.
[[nodiscard]] constexpr bool can_be_stamp(std::int64_t nanoseconds) noexcept {
  return nanoseconds > 0 && nanoseconds <= latest_stamp;
}

/// Stamps of one camera: the time of its samples minus the delay of the tracking system, strictly increasing. If the
/// clock stops or steps back a little, stamps increase by `least_step` until the clock has caught up. If that would put
/// them more than `most_ahead` ahead, they follow the clock. Not synchronised, does not allocate.
class Stamper {
 public:
  /// ns; still distinct when stamps are converted to seconds as double (resolution today: 2.4e-7 s).
  static constexpr std::int64_t least_step = 1000;
  /// ns
  static constexpr std::int64_t most_ahead = 1'000'000'000;

  explicit Stamper(std::chrono::nanoseconds delay) noexcept : delay_(delay.count()) {}

  /// Takes effect with the next stamp. After an increase, stamps are held until the time has caught up.
  void set_delay(std::chrono::nanoseconds delay) noexcept { delay_ = delay.count(); }

  /// `time` and the stamp in nanoseconds since 1970 UTC. None if it cannot be a stamp.
  [[nodiscard]] std::optional<std::int64_t> stamp(std::int64_t time) noexcept;

  /// Time minus delay, for data that needs no order; 0 ("no time") if it cannot be a stamp.
  [[nodiscard]] std::int64_t unordered(std::int64_t time) const noexcept;

  /// How many stamps were moved ahead to keep the order.
  std::uint64_t held() const noexcept { return held_; }
  /// How far the last stamp is ahead of time minus delay, ns; 0: not at all.
  std::int64_t ahead() const noexcept { return ahead_; }
  /// How often stamps went back with the clock, and by how much the last time, ns.
  std::uint64_t steps() const noexcept { return steps_; }
  std::int64_t last_step() const noexcept { return last_step_; }

 private:
  std::int64_t delay_;
  std::int64_t newest_ = 0;
  std::uint64_t held_ = 0;
  std::int64_t ahead_ = 0;
  std::uint64_t steps_ = 0;
  std::int64_t last_step_ = 0;
};

}  // namespace trk_bridge::bridge
