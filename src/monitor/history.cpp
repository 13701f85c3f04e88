// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "history.h"

#include <algorithm>

namespace trk_bridge::monitor {

void Range::add(double value) noexcept {
  if (value < low) low = value;
  if (value > high) high = value;
}

void Range::add(const Range& other) noexcept {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

void History::add(std::int64_t arrival, const Values& values) {
  if (arrival < newest_) steps_.clear();
  newest_ = arrival;
  const std::int64_t begin = arrival - arrival % step;
  if (steps_.empty() || steps_.back().begin != begin) {
    steps_.emplace_back();
    steps_.back().begin = begin;
  }
  while (begin - steps_.front().begin > length) steps_.pop_front();
  for (std::size_t i = 0; i < values.size(); ++i) steps_.back().ranges[i].add(values[i]);
}

std::vector<Range> History::columns(Value value, std::int64_t end, std::int64_t span, std::size_t columns) const {
  std::vector<Range> ranges(columns);
  for (const auto& entry : steps_) {
    // The middle of the step.
    const std::int64_t since = entry.begin + step / 2 - (end - span);
    if (since < 0 || columns == 0) continue;
    const auto column =
        static_cast<std::size_t>(static_cast<double>(since) / static_cast<double>(span) * static_cast<double>(columns));
    ranges[std::min(column, columns - 1)].add(entry.ranges[static_cast<std::size_t>(value)]);
  }
  return ranges;
}

}  // namespace trk_bridge::monitor
