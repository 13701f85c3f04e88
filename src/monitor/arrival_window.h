// How evenly records arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace trk_bridge::monitor {

/// Nanoseconds. The jitter of one interval is how far it is from the median interval, either way; percentiles are by
/// nearest rank. A record that was lost makes one interval long, and so shows here, too.
struct Jitter {
  std::int64_t interval = 0;  ///< the median
  std::int64_t p50 = 0, p99 = 0, worst = 0;
};

/// Where arrivals are not even although nothing is lost. Intervals in nanoseconds.
struct Unevenness {
  enum class Kind : std::uint8_t {
    none,    ///< or too few records to say
    stalls,  ///< now and then nothing comes for a while
    bursts,  ///< records come several at once, all the time
  };
  Kind kind = Kind::none;
  std::size_t count = 0;      ///< of stalls or bursts
  std::int64_t longest = 0;   ///< stall; of bursts: from one to the next on average
  std::size_t at_once = 0;    ///< records that came at once after the longest stall; in an average burst
  std::int64_t interval = 0;  ///< from record to record on average
};

/// The arrivals of one camera's new records within the last ten seconds. Not synchronised.
class ArrivalWindow {
 public:
  /// `arrival` in nanoseconds; one before the last, as after a clock was set back, starts the window again. `counts`:
  /// how far its counter is ahead of the record before it; more than 1 where records were lost.
  void add(std::int64_t arrival, std::uint64_t counts = 1);

  /// Records a second; none before two of them, or when all came at once.
  std::optional<double> rate() const;
  /// None before three records.
  std::optional<Jitter> jitter() const;
  /// None before a second and twenty records.
  Unevenness unevenness() const;
  /// From each record to the next.
  std::vector<std::int64_t> intervals() const;

  static constexpr std::int64_t length = 10'000'000'000;  ///< ns
  /// Of records that come faster than 400 a second the window is shorter.
  static constexpr std::size_t most = 4000;

 private:
  struct Entry {
    std::int64_t arrival;
    std::uint64_t counts;
  };
  std::deque<Entry> entries_;
};

}  // namespace trk_bridge::monitor
