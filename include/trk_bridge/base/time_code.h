// Time codes of video fields.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::base {

/// HH:MM:SS:FF:D, non-drop. A second nominally has round(field rate) fields and a frame two of them.
struct TimeCode {
  int hours = 0, minutes = 0, seconds = 0;
  int frames = 0;  ///< from 0
  int field = 1;   ///< 1 or 2
};
inline bool operator==(const TimeCode& a, const TimeCode& b) noexcept {
  return a.hours == b.hours && a.minutes == b.minutes && a.seconds == b.seconds && a.frames == b.frames &&
         a.field == b.field;
}
inline bool operator!=(const TimeCode& a, const TimeCode& b) noexcept { return !(a == b); }

/// One or two digits each. The error names the text and what is allowed. Frames may be up to 99 here, for only a field
/// rate defines how many there are: nanoseconds_of() checks that.
tl::expected<TimeCode, std::string> parse_time_code(std::string_view);
/// Two digits each, one for the field: "10:20:30:12:1".
std::string to_string(const TimeCode&);
/// Nanoseconds after midnight of the field `index` fields after the code: the nominal count of fields since midnight
/// over `field_rate` (Hz, more than 0). Beyond 24 hours it goes on rising. An error when the code has a frame or a
/// field that a second of this rate does not have.
tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode&, double field_rate, std::uint64_t index);

/// The way back: the code of the field nearest to a time after midnight (ns, not negative); after 23:59:59 the day's
/// codes begin again. An error for rates outside of 1 to 1e6 Hz and for a frame above 99, which a code cannot express.
tl::expected<TimeCode, std::string> time_code_at(std::int64_t nanoseconds, double field_rate);

}  // namespace trk_bridge::base
