// Time codes of video fields.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::base {

/// HH:MM:SS:FF:D, or HH:MM:SS;FF:D for drop-frame (SMPTE ST 12-1). A frame has two fields. Rates are those of samples:
/// one a field, up to 30 Hz one a frame. A second nominally has round(rate) of them.
struct TimeCode {
  int hours = 0, minutes = 0, seconds = 0;
  int frames = 0;  ///< from 0
  int field = 1;   ///< 1 or 2
  /// Frames 0 and 1 (of 60 a second: 0 to 3) are left out at the beginning of each minute but every tenth, so that the
  /// code follows the clock at 29.97, 59.94 and 119.88 Hz.
  bool drop_frame = false;
};
inline bool operator==(const TimeCode& a, const TimeCode& b) noexcept {
  return a.hours == b.hours && a.minutes == b.minutes && a.seconds == b.seconds && a.frames == b.frames &&
         a.field == b.field && a.drop_frame == b.drop_frame;
}
inline bool operator!=(const TimeCode& a, const TimeCode& b) noexcept { return !(a == b); }

/// A code and what it counts.
struct CountedTimeCode {
  TimeCode code;
  double rate = 0;  ///< Hz, of samples; 0: not known
};

/// The rate that a person means who writes 23.976, 29.97, 47.952, 59.94 or 119.88: 1000/1001 of a whole number of Hz.
/// Others as they are.
double exact_rate(double rate) noexcept;

/// One or two digits each. The error names the text and what is allowed. Frames may be up to 99 here, for only a field
/// rate defines how many there are: nanoseconds_of() and time_code_after() check that.
tl::expected<TimeCode, std::string> parse_time_code(std::string_view);
/// Two digits each, one for the field: "10:20:30:12:1", "10:20:30;12:1".
std::string to_string(const TimeCode&);
/// Nanoseconds after midnight of the sample `index` samples after the code: the nominal count of samples since midnight
/// over exact_rate(field_rate) (Hz, more than 0). Beyond 24 hours it goes on rising. An error when the code has a frame
/// or a field that a second of this rate does not have, or is drop-frame and the rate is not.
tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode&, double field_rate, std::uint64_t index);
/// The code of that sample. After the last one of a day comes 00:00:00:00:1. Errors as above.
tl::expected<TimeCode, std::string> time_code_after(const TimeCode&, double field_rate, std::uint64_t index);

/// The samples from a code on: the above for many indices, of which they check and prepare everything once.
class TimeCodeSeries {
 public:
  /// Errors as above.
  static tl::expected<TimeCodeSeries, std::string> from(const TimeCode&, double field_rate);

  /// As nanoseconds_of().
  std::int64_t nanoseconds(std::uint64_t index) const noexcept;
  /// As time_code_after().
  TimeCode code(std::uint64_t index) const noexcept;

 private:
  TimeCodeSeries() = default;

  std::int64_t second_ = 0;   // fields of a nominal second
  std::int64_t step_ = 1;     // fields from one sample to the next
  std::int64_t dropped_ = 0;  // fields at the beginning of a minute
  std::int64_t first_ = 0;    // fields since 00:00:00:00:1
  long double exact_second_ = 0;
};

/// The way back: the code of the field nearest to a time after midnight (ns, not negative); after 23:59:59 the day's
/// codes begin again. An error for rates outside of 1 to 1e6 Hz, for a frame above 99, which a code cannot express, and
/// for drop-frame at a rate that has none.
tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate, bool drop_frame = false);

}  // namespace trk_bridge::base
