// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The values of a camera within the last minute, for plots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

namespace trk_bridge::monitor {

/// Values that can be plotted.
enum class Value : std::uint8_t { x, y, z, pan, tilt, roll, lens, focus, iris, interval };
inline constexpr std::size_t value_count = 10;
/// Of one record, in metres, degrees, mm (lens), ms (interval); NaN: not known.
using Values = std::array<double, value_count>;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  bool is_empty() const noexcept { return low > high; }
  void add(double value) noexcept;  ///< NaN is ignored
  void add(const Range&) noexcept;
};

/// Ranges of every value in steps of 50 ms. Not synchronised.
class History {
 public:
  /// `arrival` in nanoseconds; if it is before the last one, the history is cleared.
  void add(std::int64_t arrival, const Values&);
  /// Arrival of the last record, ns; 0 before the first one.
  std::int64_t newest() const noexcept { return newest_; }
  /// The ranges of the last `span` ns before `end`, in equal columns, oldest first.
  std::vector<Range> columns(Value, std::int64_t end, std::int64_t span, std::size_t columns) const;

  static constexpr std::int64_t length = 60'000'000'000, step = 50'000'000;  ///< ns

 private:
  struct Step {
    std::int64_t begin = 0;
    std::array<Range, value_count> ranges;
  };
  std::deque<Step> steps_;
  std::int64_t newest_ = 0;
};

}  // namespace trk_bridge::monitor
