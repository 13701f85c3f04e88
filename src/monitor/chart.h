// Curves and bars of characters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "history.h"

namespace trk_bridge::monitor {

/// A curve of `rows` lines, a column for each range, with its scale at the left. Every character is two dots high: `'`
/// the upper one, `.` the lower one, `:` both. `least_range`: of the scale, when the values differ by less.
std::vector<std::string> curve(const std::vector<Range>&, std::size_t rows, int decimals, double least_range);
/// Characters that the scale takes.
inline constexpr std::size_t scale_width = 11;

/// How many of the intervals (ns) are how long: at most `rows` lines of at most `width` characters, from the shortest
/// to the longest. Where one is longer than three medians, the last line (`+`) has all that are about as long or
/// longer.
std::vector<std::string> histogram(std::vector<std::int64_t> intervals, std::size_t rows, std::size_t width);

}  // namespace trk_bridge::monitor
