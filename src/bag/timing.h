// Time codes of bags: how stamps and video fields belong together.
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

/// What the counters and stamps of fields say, one after another. Memory of a fixed size.
class FieldSeries {
 public:
  /// `field_rate` in Hz. Without counters of the sender stamps alone count.
  FieldSeries(bool has_counters, double field_rate);

  void add(std::uint64_t counter, std::int64_t stamp);
  std::uint64_t count() const noexcept { return count_; }
  /// Fields a second from counters and stamps, or from the median distance of stamps where there are no counters: of
  /// the first 100,000. None for less than two seconds.
  std::optional<double> measured_rate() const;
  /// Reports on `err` the fields that the recording lacks, and counters that came again.
  void report_gaps(std::ostream& err) const;

 private:
  /// Missing fields between neighbours, as a gap at the stamp before.
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

/// Throws BagError where the rate measured is another than the bag's or the default, and warns on `err` of the user's
/// `option`.
void check_rate(double rate, std::optional<double> option, std::optional<double> measured, std::ostream& err);

/// The message of a topic `time_code` that has this stamp, if the bag has one. Throws BagError where it is no time
/// code.
std::optional<base::CountedTimeCode> recorded_time_code(Reader&, const std::string& topic, std::int64_t stamp);

/// The code of a stamp, counted from the bag's zero where it has one that is not later, else from midnight UTC.
tl::expected<base::TimeCode, std::string> time_code_of(std::int64_t stamp, double field_rate,
                                                       std::optional<std::int64_t> zero);

}  // namespace trk_bridge::bag
