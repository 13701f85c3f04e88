// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures how evenly records arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace trk_bridge::monitor {

/// Nanoseconds. The jitter of an interval is its absolute difference from the median interval; percentiles use the
/// nearest rank. A lost record makes one interval longer, so it is visible here, too.
struct Jitter {
  std::int64_t interval = 0;  ///< the median
  std::int64_t p50 = 0, p99 = 0, worst = 0;
};

/// Uneven arrivals although nothing is lost. Intervals in nanoseconds.
struct Unevenness {
  enum class Kind : std::uint8_t {
    none,    ///< or too few records
    stalls,  ///< occasional pauses
    bursts,  ///< several records arrive at once, all the time
  };
  Kind kind = Kind::none;
  std::size_t count = 0;      ///< of stalls or bursts
  std::int64_t longest = 0;   ///< stall; for bursts: average time from one to the next
  std::size_t at_once = 0;    ///< records that arrived at once after the longest stall; in an average burst
  std::int64_t interval = 0;  ///< average from record to record
};

/// The arrivals of one camera's new records within the last ten seconds. Not synchronised.
class ArrivalWindow {
 public:
  /// `arrival` in nanoseconds; if it is before the last one, because a clock was set back, the window is cleared.
  /// `counts`: by how much the counter increased; more than 1 if records were lost.
  void add(std::int64_t arrival, std::uint64_t counts = 1);

  /// Records a second; none before the second record, or if all arrived at once.
  std::optional<double> rate() const;
  /// None before the third record.
  std::optional<Jitter> jitter() const;
  /// Kind::none before one second and twenty records.
  Unevenness unevenness() const;
  /// The interval from each record to the next.
  std::vector<std::int64_t> intervals() const;

  static constexpr std::int64_t length = 10'000'000'000;  ///< ns
  /// Above 400 records a second, the window is shorter.
  static constexpr std::size_t most = 4000;

 private:
  struct Entry {
    std::int64_t arrival;
    std::uint64_t counts;
  };
  std::deque<Entry> entries_;
};

}  // namespace trk_bridge::monitor
