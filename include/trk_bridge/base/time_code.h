// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Time codes of video fields.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::base {

/// HH:MM:SS:FF:D, or HH:MM:SS;FF:D for drop-frame (SMPTE ST 12-1). A frame has two fields. Rates are sample rates: one
/// sample per field; up to 30 Hz, one per frame. A nominal second has round(rate) samples.
struct TimeCode {
  int hours = 0, minutes = 0, seconds = 0;
  int frames = 0;  ///< from 0
  int field = 1;   ///< 1 or 2
  /// Frames 0 and 1 (at 60 frames per second: 0 to 3) are skipped at the beginning of each minute, except every tenth,
  /// so that the code follows the clock at 29.97, 59.94 and 119.88 Hz.
  bool drop_frame = false;
};
inline bool operator==(const TimeCode& a, const TimeCode& b) noexcept {
  return a.hours == b.hours && a.minutes == b.minutes && a.seconds == b.seconds && a.frames == b.frames &&
         a.field == b.field && a.drop_frame == b.drop_frame;
}
inline bool operator!=(const TimeCode& a, const TimeCode& b) noexcept { return !(a == b); }

/// A time code and the rate of the samples that it counts.
struct TimeCodeWithRate {
  TimeCode code;
  double rate = 0;  ///< Hz, of samples; 0: not known
};

/// The exact rate for 23.976, 29.97, 47.952, 59.94 or 119.88: a whole number of Hz times 1000/1001. Other rates are
/// returned unchanged.
double exact_rate(double rate) noexcept;

/// One or two digits each. The error names the text and what is allowed. Frames may be up to 99: their number depends
/// on the field rate, which nanoseconds_of() and time_code_after() check.
tl::expected<TimeCode, std::string> parse_time_code(std::string_view);
/// Two digits each, one for the field: "10:20:30:12:1", "10:20:30;12:1".
std::string to_string(const TimeCode&);
/// Time of the sample that comes `index` samples after the code, in nanoseconds after midnight: the nominal number of
/// samples since midnight, divided by exact_rate(field_rate) (Hz, more than 0). It increases beyond 24 hours. An error
/// if the code has a frame or a field that does not exist at this rate, or is drop-frame at a rate that is not.
tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode&, double field_rate, std::uint64_t index);
/// The code of that sample. The last one of a day is followed by 00:00:00:00:1. Errors as above.
tl::expected<TimeCode, std::string> time_code_after(const TimeCode&, double field_rate, std::uint64_t index);

/// The samples from a code on. Checks and prepares once what the functions above do for each index.
class TimeCodeSeries {
 public:
  /// Errors as for nanoseconds_of().
  static tl::expected<TimeCodeSeries, std::string> from(const TimeCode&, double field_rate);

  /// See nanoseconds_of().
  std::int64_t nanoseconds(std::uint64_t index) const noexcept;
  /// See time_code_after().
  TimeCode code(std::uint64_t index) const noexcept;

 private:
  TimeCodeSeries() = default;

  std::int64_t second_ = 0;   // fields per nominal second
  std::int64_t step_ = 1;     // fields from one sample to the next
  std::int64_t dropped_ = 0;  // fields skipped at the beginning of a minute
  std::int64_t first_ = 0;    // fields since 00:00:00:00:1
  long double exact_second_ = 0;
};

/// The inverse: the code of the field nearest to a time after midnight (ns, not negative). After 23:59:59 the codes
/// start again at 00:00:00. An error for rates outside of 1 to 1e6 Hz, for a frame above 99, which a code cannot
/// express, and for drop-frame at a rate that has none.
tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate, bool drop_frame = false);

}  // namespace trk_bridge::base
