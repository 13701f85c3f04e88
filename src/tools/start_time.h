// Moments as they are written on a command line.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

namespace trk_bridge::tools {

/// "2026-11-22" in UTC: its midnight in ns since 1970. The error says what is allowed.
tl::expected<std::int64_t, std::string> parse_date(const std::string& text);

/// "2026-11-22T10:20:30.5" in UTC (a Z at the end is allowed), or seconds since 1970 ("1795342830.5"), to the
/// nanosecond: ns since 1970, more than 0. The error says what is allowed.
tl::expected<std::int64_t, std::string> parse_moment(const std::string& text);

}  // namespace trk_bridge::tools
