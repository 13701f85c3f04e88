// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Formats numbers and words for diagnostics.
#pragma once

#include <cstdint>
#include <string>

#include "constants_origin.h"

namespace trk_bridge::bridge {

/// "3.2 s"
std::string duration_text(double seconds);
/// "3.20"
std::string two_decimals(double value);
/// With three decimals.
std::string pixels_text(double pixels);
/// px; a smaller lens error is not visible.
inline constexpr double visible_pixels = 0.01;
/// Seconds since `then`, "never" unless `ever`. `then` and `now` in ns.
std::string age_text(bool ever, std::int64_t then, std::int64_t now);
/// Whether constants are known, and their origin.
const char* constants_text(ConstantsOrigin) noexcept;

/// `from` and `to` in ns.
double seconds_between(std::int64_t from, std::int64_t to) noexcept;
/// Events per second between two reports, `from` and `to` in ns; 0 if no time has passed.
double rate_between(std::uint64_t events_before, std::uint64_t events_now, std::int64_t from, std::int64_t to) noexcept;

}  // namespace trk_bridge::bridge
