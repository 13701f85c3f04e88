// Time codes of bags: how stamps and video fields belong together.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "fields.h"
#include "trk_bridge/base/time_code.h"

namespace trk_bridge::bag {

/// What `trk bag` adds to the connection headers of a camera's topics, since no message contains it: fields a second,
/// and when the time code was 00:00:00:00:1, in ns since 1970. rosbag's cutting and filtering keep it, a new recording
/// does not.
inline constexpr const char* field_rate_key = "field_rate";
inline constexpr const char* time_code_zero_key = "time_code_zero";

inline constexpr double default_field_rate = 50;  // Hz, trk_to_ros's

struct RecordedTiming {
  std::optional<double> field_rate;
  std::optional<std::int64_t> time_code_zero;
};
/// From the connection headers of a topic, where all of them agree.
RecordedTiming recorded_timing(const std::vector<Connection>&, const std::string& topic);

/// Fields a second from counters and stamps, or from the median distance of stamps where there are no counters. None
/// for less than two seconds.
std::optional<double> measured_rate(const Fields&);

/// The user's `option`, else the bag's, else 50. Where the stamps disagree with it: a warning on `err` for the user's
/// own, BagError for the others.
double field_rate_of(std::optional<double> option, std::optional<double> of_bag, std::optional<double> measured,
                     std::ostream& err);

/// The message of a topic `time_code` that has this stamp, if the bag has one. Throws BagError where it is no time
/// code.
std::optional<base::CountedTimeCode> recorded_time_code(Reader&, const std::string& topic, std::int64_t stamp);

/// The code of a stamp, counted from the bag's zero where it has one that is not later, else from midnight UTC.
tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                       std::optional<std::int64_t> zero);

/// Reports on `err` the fields that the recording lacks, and counters that came again.
void report_gaps(const Fields&, double field_rate, std::ostream& err);

}  // namespace trk_bridge::bag
