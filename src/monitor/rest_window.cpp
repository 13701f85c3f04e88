// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "rest_window.h"

#include <algorithm>
#include <cmath>

namespace trk_bridge::monitor {
void RestWindow::add(std::int64_t arrival, const PoseNumbers& pose) {
  if (!entries_.empty() && arrival < entries_.back().arrival) entries_.clear();
  entries_.push_back({arrival, pose});
  while (arrival - entries_.front().arrival > length || entries_.size() > most) entries_.pop_front();
}

Rest RestWindow::classify() const {
  Rest rest;
  if (entries_.size() < fewest || (entries_.back().arrival - entries_.front().arrival) < length / 10 * 9) return rest;
  rest.motion = Motion::still;
  for (std::size_t i = 0; i < rest.deviation.size(); ++i) {
    if (!is_still(i)) return Rest{Motion::moving, {}};
    rest.deviation[i] = deviation(i);
  }
  return rest;
}

double RestWindow::offset(std::size_t n, std::size_t i) const {
  const double difference = entries_[n].pose[i] - entries_.front().pose[i];
  return i < first_angle ? difference : std::remainder(difference, 360.0);
}

bool RestWindow::is_still(std::size_t i) const {
  double low = 0, high = 0;
  for (std::size_t n = 1; n < entries_.size(); ++n) {
    low = std::min(low, offset(n, i));
    high = std::max(high, offset(n, i));
  }
  const std::size_t middle = entries_.size() / 2;
  const double drift = mean(i, middle, entries_.size()) - mean(i, 0, middle);
  return high - low <= most_range[i] && std::abs(drift) <= most_drift[i];
}

double RestWindow::deviation(std::size_t i) const {
  const double middle = mean(i, 0, entries_.size());
  double squares = 0;
  for (std::size_t n = 0; n < entries_.size(); ++n) squares += std::pow(offset(n, i) - middle, 2);
  return std::sqrt(squares / static_cast<double>(entries_.size() - 1));
}

double RestWindow::mean(std::size_t i, std::size_t begin, std::size_t end) const {
  double sum = 0;
  for (std::size_t n = begin; n < end; ++n) sum += offset(n, i);
  return sum / static_cast<double>(end - begin);
}

}  // namespace trk_bridge::monitor
