// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Time codes of bags: the relation between stamps and video fields.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "fields.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/base/time_code.h"

namespace trk_bridge::bag {

/// Entries that `trk bag` adds to the connection headers of a camera's topics, because no message contains them: fields
/// a second, and when the time code was 00:00:00:00:1, in ns since 1970. `rosbag filter` keeps them, a new recording
/// does not.
inline constexpr const char* field_rate_key = "field_rate";
inline constexpr const char* time_code_zero_key = "time_code_zero";

inline constexpr double default_field_rate = 50;  // Hz, the default of trk_to_ros

struct RecordedTiming {
  std::optional<double> field_rate;
  std::optional<std::int64_t> time_code_zero;
};
/// From the connection headers of a topic; none where they differ.
RecordedTiming recorded_timing(const std::vector<Connection>&, const std::string& topic);

/// Measures rate and gaps from the counters and stamps of fields. Uses memory of a fixed size.
class FieldSeries {
 public:
  /// `field_rate` in Hz. Without counters of the sender, only stamps are used.
  FieldSeries(bool has_counters, double field_rate);

  void add(std::uint64_t counter, std::int64_t stamp);
  std::uint64_t count() const noexcept { return count_; }
  /// Fields a second from counters and stamps or, without counters, from the median distance of the first 100,000
  /// stamps. None for less than two seconds.
  std::optional<double> measured_rate() const;
  /// Reports missing fields and repeated counters on `err`.
  void report_gaps(std::ostream& err) const;

 private:
  /// Missing fields between neighbours; a gap has the stamp before it.
  struct Gaps {
    std::uint64_t gaps = 0, fields = 0, first_fields = 0;
    std::int64_t first = 0;
  };

  void add_gap(std::uint64_t missing);
  void add_distance(std::uint64_t counter, std::int64_t stamp);
  void find_gap(std::uint64_t counter, std::int64_t stamp);

  const bool has_counters_;
  const double field_rate_;
  std::uint64_t count_ = 0;
  std::int64_t first_stamp_ = 0, stamp_ = 0;
  std::uint64_t counter_ = 0;
  long double counts_ = 0, nanoseconds_ = 0;
  std::vector<std::int64_t> distances_;
  base::Sequence sequence_;
  Gaps gaps_;
};

/// If the measured rate differs: throws BagError for the rate of the bag or the default, warns on `err` for the user's
/// `option`.
void check_rate(double rate, std::optional<double> option, std::optional<double> measured, std::ostream& err);

/// The message with this stamp on a topic `time_code`, if the bag has one. Throws BagError if it is not a time code.
std::optional<base::TimeCodeWithRate> recorded_time_code(Reader&, const std::string& topic, std::int64_t stamp);

/// The time code of a stamp, counted from the zero of the bag if it has one that is not later, else from midnight UTC.
tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                       std::optional<std::int64_t> zero);

}  // namespace trk_bridge::bag
