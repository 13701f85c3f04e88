// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "arrival_window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trk_bridge::monitor {
namespace {

constexpr std::size_t fewest = 20;              // intervals that are needed
constexpr std::int64_t shortest = 900'000'000;  // ns that are needed
// In average intervals.
constexpr double at_once = 0.25, gap = 1.5, stall = 3;
constexpr double least_stall = 30e6;     // ns
constexpr double share_of_bursts = 0.4;  // of intervals within bursts
constexpr std::size_t fewest_bursts = 3;

/// Reorders `values`, which must not be empty.
std::int64_t percentile(std::vector<std::int64_t>& values, double fraction) {
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

void ArrivalWindow::add(std::int64_t arrival, std::uint64_t counts) {
  if (!entries_.empty() && arrival < entries_.back().arrival) entries_.clear();
  entries_.push_back({arrival, std::max<std::uint64_t>(counts, 1)});
  while (arrival - entries_.front().arrival > length || entries_.size() > most) entries_.pop_front();
}

std::optional<double> ArrivalWindow::rate() const {
  if (entries_.size() < 2 || entries_.back().arrival == entries_.front().arrival) return std::nullopt;
  return static_cast<double>(entries_.size() - 1) * 1e9 /
         static_cast<double>(entries_.back().arrival - entries_.front().arrival);
}

std::vector<std::int64_t> ArrivalWindow::intervals() const {
  std::vector<std::int64_t> intervals;
  intervals.reserve(entries_.size());
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    intervals.push_back(entries_[i].arrival - entries_[i - 1].arrival);
  }
  return intervals;
}

std::optional<Jitter> ArrivalWindow::jitter() const {
  if (entries_.size() < 3) return std::nullopt;
  auto intervals = this->intervals();
  Jitter jitter;
  jitter.interval = percentile(intervals, 0.5);
  for (auto& interval : intervals) interval = std::abs(interval - jitter.interval);
  jitter.p50 = percentile(intervals, 0.5);
  jitter.p99 = percentile(intervals, 0.99);
  jitter.worst = *std::max_element(intervals.begin(), intervals.end());
  return jitter;
}

Unevenness ArrivalWindow::unevenness() const {
  if (entries_.size() <= fewest || entries_.back().arrival - entries_.front().arrival < shortest) return {};
  const auto intervals = this->intervals();
  double counts = 0;
  for (std::size_t i = 1; i < entries_.size(); ++i) counts += static_cast<double>(entries_[i].counts);
  const double average = static_cast<double>(entries_.back().arrival - entries_.front().arrival) / counts;

  Unevenness stalls, bursts;
  std::int64_t all_gaps = 0;
  std::size_t together = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const auto interval = static_cast<double>(intervals[i]);
    if (interval <= at_once * average) ++together;
    if (interval < gap * average) continue;
    ++bursts.count;
    all_gaps += intervals[i];
    // Records missing in the counter were lost: their time is not a pause of the sender.
    const double unexplained = interval - static_cast<double>(entries_[i + 1].counts) * average;
    if (unexplained < std::max(stall * average, least_stall)) continue;
    ++stalls.count;
    if (intervals[i] <= stalls.longest) continue;
    stalls.longest = intervals[i];
    stalls.at_once = 1;
    for (std::size_t k = i + 1; k < intervals.size(); ++k, ++stalls.at_once) {
      if (static_cast<double>(intervals[k]) > at_once * average) break;
    }
  }

  const bool has_bursts = bursts.count >= fewest_bursts &&
                          static_cast<double>(together) >= share_of_bursts * static_cast<double>(intervals.size());
  if (!has_bursts && stalls.count == 0) return {};
  Unevenness found = has_bursts ? bursts : stalls;
  found.kind = has_bursts ? Unevenness::Kind::bursts : Unevenness::Kind::stalls;
  found.interval = std::llround(average);
  if (has_bursts) {
    const auto number = static_cast<double>(bursts.count);
    found.longest = std::llround(static_cast<double>(all_gaps) / number);
    found.at_once = static_cast<std::size_t>(std::lround(static_cast<double>(intervals.size()) / number));
    found.interval = found.longest / static_cast<std::int64_t>(found.at_once);
  }
  return found;
}

}  // namespace trk_bridge::monitor
