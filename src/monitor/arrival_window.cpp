#include "arrival_window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace trk_bridge::monitor {
namespace {

/// Reorders `values`, of which there is at least one.
std::int64_t percentile(std::vector<std::int64_t>& values, double fraction) {
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

void ArrivalWindow::add(std::int64_t arrival) {
  if (!arrivals_.empty() && arrival < arrivals_.back()) arrivals_.clear();
  arrivals_.push_back(arrival);
  while (arrival - arrivals_.front() > length || arrivals_.size() > most) arrivals_.pop_front();
}

std::optional<double> ArrivalWindow::rate() const {
  if (arrivals_.size() < 2 || arrivals_.back() == arrivals_.front()) return std::nullopt;
  return static_cast<double>(arrivals_.size() - 1) * 1e9 / static_cast<double>(arrivals_.back() - arrivals_.front());
}

std::optional<Jitter> ArrivalWindow::jitter() const {
  if (arrivals_.size() < 3) return std::nullopt;
  std::vector<std::int64_t> intervals;
  intervals.reserve(arrivals_.size() - 1);
  for (std::size_t i = 1; i < arrivals_.size(); ++i) intervals.push_back(arrivals_[i] - arrivals_[i - 1]);
  Jitter jitter;
  jitter.interval = percentile(intervals, 0.5);
  for (auto& interval : intervals) interval = std::abs(interval - jitter.interval);
  jitter.p50 = percentile(intervals, 0.5);
  jitter.p99 = percentile(intervals, 0.99);
  jitter.worst = *std::max_element(intervals.begin(), intervals.end());
  return jitter;
}

}  // namespace trk_bridge::monitor
