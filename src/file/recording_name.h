// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Names of recordings, with the time of their first field or with numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "take_writer.h"

namespace trk_bridge::file {

/// `crane-%Y%m%d-%H%M%S.trk`: the conversions %Y %y %m %d %j %H %M %S of strftime, for the UTC time of the first field.
/// Other bytes may be written as %XX, as in every URL; if XX begins with a D, it must be a capital, because %d is the
/// day.
class RecordingName {
 public:
  /// `text` as in a URL. The error names it and what is allowed.
  static tl::expected<RecordingName, std::string> parse(std::string_view text);

  /// Whether the name depends on the time.
  bool has_time() const noexcept { return has_time_; }
  /// The name for a time, nanoseconds since 1970. Empty if the name is too long for a file.
  std::string at(std::int64_t time) const;
  /// The name with its conversions, for users.
  std::string shown() const;
  /// A pattern for glob(3) that matches all names that it can have.
  std::string pattern() const;

 private:
  std::string format_;  // for strftime
  bool has_time_ = false;
};

/// Opens `take-001.trk` for `take.trk`, with the number after the highest one of any file with such a name and any
/// further extension. No other writer gets the same number. no_free_number after 9999.
OpenedFile open_next_number(const std::string& path);

/// Publishes the unfinished recordings of dead writers with such names (recover_part), with or without numbers. Returns
/// the new names.
std::vector<std::string> recover_parts(const RecordingName&, bool numbered);

}  // namespace trk_bridge::file
