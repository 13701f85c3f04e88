// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Times as text that users write and read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::base {

/// "2026-11-22", a day from 1970 to 9999: its midnight UTC in seconds since 1970. None for other texts.
std::optional<std::int64_t> day_from_text(std::string_view text);

/// The same in nanoseconds, for days that ROS can represent (up to 2106-02-06). The error gives the allowed range.
tl::expected<std::int64_t, std::string> parse_date(const std::string& text);

/// "2026-11-22T10:20:30.5" in UTC (a Z at the end is allowed), or seconds since 1970 ("1795342830.5"), with up to 9
/// decimals. Returns ns since 1970, more than 0 and within the range of ROS (to the second 2106-02-07T06:28:15). The
/// error gives the allowed forms.
tl::expected<std::int64_t, std::string> parse_moment(const std::string& text);

/// "1700000000.123456789" from nanoseconds since 1970.
std::string seconds_text(std::int64_t nanoseconds);
/// "2023-11-14T22:13:20.123456789Z" from nanoseconds since 1970.
std::string iso_time(std::int64_t nanoseconds);

}  // namespace trk_bridge::base
