// What recordings are called: names with the time of their first field, and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "take_writer.h"

namespace trk_bridge::file {

/// `crane-%Y%m%d-%H%M%S.trk`: of strftime's conversions, %Y %y %m %d %j %H %M %S, of the UTC time of the first field.
/// Other bytes may be written as %XX as in every URL; one that begins with a D must have it as a capital, since %d is
/// the day.
class RecordingName {
 public:
  /// `text` as it stands in a URL. The error names it and says what is allowed.
  static tl::expected<RecordingName, std::string> parse(std::string_view text);

  /// Whether it depends on the time.
  bool has_time() const noexcept { return has_time_; }
  /// With the time filled in, nanoseconds since 1970. Empty where the name is too long for any file.
  std::string at(std::int64_t time) const;
  /// With the conversions as they are.
  std::string shown() const;
  /// A pattern for glob(3) of all names that it can have, between the begin and the end of what else is in the name.
  std::string pattern() const;

 private:
  std::string format_;  // for strftime
  bool has_time_ = false;
};

/// `take.trk` with the number that follows the highest that a file of such a name has, as `take-001.trk`, whatever else
/// the file's name ends in. No other writer gets the same. no_free_number after 9999.
OpenedFile open_next_number(const std::string& path);

/// Publishes what dead writers left of recordings with such names (recover_part), with a number in them or not; the new
/// names.
std::vector<std::string> recover_parts(const RecordingName&, bool numbered);

}  // namespace trk_bridge::file
