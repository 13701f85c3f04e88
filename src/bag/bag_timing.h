// Time codes of bags: how stamps and video fields belong together.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bag_file.h"
#include "file/take.h"

namespace trk_bridge::bag {

/// What `trk bag` adds to the connections of a camera's topics, since no message tells it: fields a second, and when
/// the time code was 00:00:00:00:1, in ns since 1970. It survives rosbag's cutting and filtering, not a new recording.
inline constexpr const char* field_rate_key = "field_rate";
inline constexpr const char* time_code_zero_key = "time_code_zero";

inline constexpr double default_field_rate = 50;  // Hz, trk_to_ros's

/// The shortest text that reads back.
std::string rate_text(double hertz);

struct Clockwork {
  std::optional<double> field_rate;
  std::optional<std::int64_t> time_code_zero;
};
/// What the connections of a topic say, where all of them say the same.
Clockwork clockwork_of(const std::vector<BagConnection>&, const std::string& topic);

/// Fields a second as counters and stamps tell it; as the median distance of stamps tells it where there are no
/// counters. None below two seconds' worth.
std::optional<double> measured_rate(const std::vector<wire::CameraParams>&, const std::vector<std::int64_t>& stamps,
                                    bool has_counters);

/// `said` by the user, else by the bag, else 50, where the stamps do not speak against it: then BagError. A user who is
/// contradicted is told on `err`.
double field_rate_of(std::optional<double> said, std::optional<double> of_bag, std::optional<double> measured,
                     std::ostream& err);

/// The code of a stamp, counted from the bag's zero where it has one that is not later, else from midnight UTC.
tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                            std::optional<std::int64_t> zero);

/// Fields that the recording lacks, and counters that came again, on `err`.
void tell_gaps(const std::vector<wire::CameraParams>&, const std::vector<std::int64_t>& stamps, bool has_counters,
               double field_rate, std::ostream& err);

}  // namespace trk_bridge::bag
