// How evenly records arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace trk_bridge::monitor {

/// Nanoseconds. The jitter of one interval is how far it is from the median interval, either way; percentiles are by
/// nearest rank. A record that was lost makes one interval long, and so shows here, too.
struct Jitter {
  std::int64_t interval = 0;  ///< the median
  std::int64_t p50 = 0, p99 = 0, worst = 0;
};

/// The arrivals of one camera's new records within the last ten seconds. Not synchronised.
class ArrivalWindow {
 public:
  /// `arrival` in nanoseconds; one before the last, as after a clock was set back, starts the window again.
  void add(std::int64_t arrival);

  /// Records a second; none before two of them, or when all came at once.
  std::optional<double> rate() const;
  /// None before three records.
  std::optional<Jitter> jitter() const;

  static constexpr std::int64_t length = 10'000'000'000;  ///< ns
  /// Of records that come faster than 400 a second the window is shorter.
  static constexpr std::size_t most = 4000;

 private:
  std::deque<std::int64_t> arrivals_;
};

}  // namespace trk_bridge::monitor
