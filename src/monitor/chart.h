// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Curves and bars drawn with characters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "history.h"

namespace trk_bridge::monitor {

/// A curve of `rows` lines with one column per range, and its scale on the left. Every character has two dots: `'` is
/// the upper one, `.` the lower one, `:` both. `least_range`: smallest range of the scale.
std::vector<std::string> curve(const std::vector<Range>&, std::size_t rows, int decimals, double least_range);
/// Width of the scale in characters.
inline constexpr std::size_t scale_width = 11;

/// A histogram of intervals (ns): at most `rows` lines of at most `width` characters, from the shortest to the longest.
/// If one is longer than three medians, the last line (`+`) contains all from about that length.
std::vector<std::string> histogram(std::vector<std::int64_t> intervals, std::size_t rows, std::size_t width);

}  // namespace trk_bridge::monitor
