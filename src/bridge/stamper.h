// When a sample was valid, as a time that ROS and tf can use.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace trk_bridge::bridge {

/// The last nanosecond since 1970 UTC that can be a stamp. Stamps are for ROS, whose times are unsigned 32 bit seconds:
/// they end in 2106, and 0 means "no time".
inline constexpr std::int64_t latest_stamp =
    std::int64_t{std::numeric_limits<std::uint32_t>::max()} * 1'000'000'000 + 999'999'999;

/// Whether nanoseconds since 1970 UTC can be a stamp: more than 0, at most latest_stamp.
[[nodiscard]] constexpr bool can_be_stamp(std::int64_t nanoseconds) noexcept {
  return nanoseconds > 0 && nanoseconds <= latest_stamp;
}

/// Stamps of one camera: when its samples were taken, less the tracking system's delay, strictly increasing. Where the
/// clock stands or steps back by a little, stamps go on by `least_step` from the newest one until it has caught up.
/// Where that would put them ahead by more than `most_ahead`, they follow the clock. Not synchronised, never allocates.
class Stamper {
 public:
  /// ns; still apart when a stamp is taken for a double of seconds (2.4e-7 s near today's date).
  static constexpr std::int64_t least_step = 1000;
  /// ns
  static constexpr std::int64_t most_ahead = 1'000'000'000;

  explicit Stamper(std::chrono::nanoseconds delay) noexcept : delay_(delay.count()) {}

  /// Counts from the next stamp on. A longer one holds stamps until the time has caught up.
  void set_delay(std::chrono::nanoseconds delay) noexcept { delay_ = delay.count(); }

  /// `time` and the stamp in nanoseconds since 1970 UTC. None where it cannot be a stamp.
  [[nodiscard]] std::optional<std::int64_t> stamp(std::int64_t time) noexcept;

  /// Time less delay alone, for what needs no order; 0 ("no time") where it cannot be a stamp.
  [[nodiscard]] std::int64_t unordered(std::int64_t time) const noexcept;

  /// Stamps that could not be time less delay.
  std::uint64_t held() const noexcept { return held_; }
  /// How far the last stamp is ahead of its time less delay, nanoseconds; 0 in order.
  std::int64_t ahead() const noexcept { return ahead_; }
  /// How often stamps went back with the clock, and how far they did the last time, ns.
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
