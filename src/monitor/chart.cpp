// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "text.h"

namespace trk_bridge::monitor {
namespace {

constexpr double least_histogram = 1e6;  // ns
constexpr std::size_t most_bins = 15;
constexpr double most_medians = 3;

std::string right_aligned(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

/// At least `least` wide, with the same centre.
Range widened(Range range, double least) {
  const double missing = least - (range.high - range.low);
  if (missing > 0) range = {range.low - missing / 2, range.high + missing / 2};
  return range;
}

}  // namespace

std::vector<std::string> curve(const std::vector<Range>& ranges, std::size_t rows, int decimals, double least_range) {
  std::vector<std::string> lines(rows, std::string(scale_width + ranges.size(), ' '));
  Range all;
  for (const auto& range : ranges) all.add(range);
  if (rows == 0 || all.is_empty() || !std::isfinite(all.low) || !std::isfinite(all.high)) return lines;
  all = widened(all, least_range);
  const auto write_scale = [&](std::size_t row, double value) {
    const auto text = right_aligned(fixed(value, decimals), scale_width - 1).substr(0, scale_width - 1);
    lines[row].replace(0, text.size(), text);
  };
  write_scale(rows - 1, all.low);
  write_scale(0, all.high);
  const auto dot = [&](double value) {
    return static_cast<std::size_t>(
        std::lround((value - all.low) / (all.high - all.low) * static_cast<double>(2 * rows - 1)));
  };
  for (std::size_t column = 0; column < ranges.size(); ++column) {
    if (ranges[column].is_empty()) continue;
    const std::size_t low = dot(ranges[column].low), high = dot(ranges[column].high);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t lower = 2 * (rows - 1 - row), upper = lower + 1;
      const bool has_lower = low <= lower && lower <= high, has_upper = low <= upper && upper <= high;
      if (has_lower || has_upper) lines[row][scale_width + column] = has_lower ? (has_upper ? ':' : '.') : '\'';
    }
  }
  return lines;
}

std::vector<std::string> histogram(std::vector<std::int64_t> intervals, std::size_t rows, std::size_t width) {
  if (rows == 0 || intervals.empty()) return {};
  // Odd, so that equal intervals are in the centre of a bin.
  const std::size_t bins = std::min(rows, most_bins) - (rows % 2 == 0 && rows < most_bins ? 1 : 0);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  const double most_shown = most_medians * static_cast<double>(*middle);
  Range range;
  for (const auto interval : intervals) range.add(static_cast<double>(interval));
  const bool has_longer = *middle > 0 && range.high > most_shown;
  if (has_longer) range.high = most_shown;
  range = widened(range, least_histogram);
  const double bin = (range.high - range.low) / static_cast<double>(bins);
  std::vector<std::size_t> counts(bins);
  for (const auto interval : intervals) {
    const double at = std::max((static_cast<double>(interval) - range.low) / bin, 0.0);
    ++counts[std::min(static_cast<std::size_t>(at), bins - 1)];
  }
  const std::size_t most = *std::max_element(counts.begin(), counts.end());
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < bins; ++i) {
    const bool is_open = has_longer && i + 1 == bins;
    char text[48];
    std::snprintf(text, sizeof text, "%8.2f%sms %5zu ", (range.low + (static_cast<double>(i) + 0.5) * bin) * 1e-6,
                  is_open ? "+" : " ", counts[i]);
    std::string line(text);
    if (line.size() < width && counts[i] > 0) {
      line.append(std::max<std::size_t>(1, counts[i] * (width - line.size()) / most), '#');
    }
    lines.push_back(line.substr(0, width));
  }
  return lines;
}

}  // namespace trk_bridge::monitor
