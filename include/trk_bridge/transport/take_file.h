// A take: the text file of one camera's parameters, one set a video field (wire format, "File").
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::transport {

/// HH:MM:SS:FF:D, non-drop: the field `index` after it is at (nominal field count)/rate seconds after midnight, where a
/// second nominally has round(rate) fields and a frame two.
struct TimeCode {
  int hours = 0, minutes = 0, seconds = 0, frames = 0, field = 1;
};

/// The error names the text and what is allowed. `frames` is checked against `field_rate` by `seconds_of`.
tl::expected<TimeCode, std::string> parse_time_code(std::string_view);
std::string to_string(const TimeCode&);
/// Nanoseconds after midnight of the field `index` fields after the code. An error when the code has a frame that a
/// second of this rate does not have.
tl::expected<std::int64_t, std::string> nanoseconds_of(const TimeCode&, double field_rate, std::uint64_t index);

struct Take {
  TimeCode time_code;
  wire::CameraConstants constants;
  std::vector<wire::CameraParams> params;
};

/// Reads a whole take. Throws TransportError: `PATH:LINE: what is wrong`, or that it cannot be read.
Take read_take(const std::string& path);

}  // namespace trk_bridge::transport
