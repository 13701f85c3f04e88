// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace trk_bridge::delay {
namespace {

constexpr double longest_gap = 0.15;  // s between samples that are interpolated

}  // namespace

void Path::add(double time, const Turn& turn) {
  turned_.push_back(turned_.empty() ? Turn::Zero() : Turn(turned_.back() + turn));
  times_.push_back(time);
}

bool Path::covers(double from, double to) const {
  if (times_.size() < 4 || from < times_[1]) return false;
  for (auto next = std::upper_bound(times_.begin(), times_.end() - 1, from); next != times_.end() - 1; ++next) {
    if (*next - *(next - 1) > longest_gap) return false;
    if (*next >= to) return true;
  }
  return false;
}

double Path::interval() const {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_.size(); ++i) intervals.push_back(times_[i] - times_[i - 1]);
  return median(intervals);
}

// Cubic interpolation: with linear interpolation the best delay would be biased to those at which frames coincide with
// samples.
Turn Path::at(double time) const {
  const auto found = std::upper_bound(times_.begin() + 2, times_.end() - 2, time);
  const auto next = static_cast<std::size_t>(found - times_.begin());
  const double interval = times_[next] - times_[next - 1];
  const double part = (time - times_[next - 1]) / interval, rest = 1 - part;
  const auto slope = [&](std::size_t i) -> Turn {
    return (turned_[i + 1] - turned_[i - 1]) * (interval / (times_[i + 1] - times_[i - 1]));
  };
  return rest * rest * ((1 + 2 * part) * turned_[next - 1] + part * slope(next - 1)) +
         part * part * ((1 + 2 * rest) * turned_[next] - rest * slope(next));
}

void Sums::add(const Turn& picture, const Turn& tracking) {
  mixed_ += picture.cwiseProduct(tracking);
  picture_ += picture.cwiseAbs2();
  tracking_ += tracking.cwiseAbs2();
  ++count_;
}

double Sums::scale(int axis) const { return tracking_[axis] > 0 ? mixed_[axis] / tracking_[axis] : 0; }

double Sums::scale_error(int axis) const {
  if (!(tracking_[axis] > 0)) return std::numeric_limits<double>::infinity();
  const double left = std::max(0.0, picture_[axis] - scale(axis) * mixed_[axis]);
  return std::sqrt(left / count_ / tracking_[axis]);
}

double Sums::correlation(int axis) const {
  const double both = std::sqrt(picture_[axis] * tracking_[axis]);
  return both > 0 ? mixed_[axis] / both : 0;
}

double Sums::explained(bool also_wrong_signs) const {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (also_wrong_signs || mixed_[axis] > 0) sum += scale(axis) * mixed_[axis];
  }
  return picture_.sum() > 0 ? std::min(sum / picture_.sum(), 1.0) : 0;
}

Sums Comparison::sums(double delay) const {
  Sums sums;
  for (const Span& span : spans_) sums.add(span.turn, tracking(span, delay));
  return sums;
}

double Comparison::refined(double delay, double step, bool also_wrong_signs) const {
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    const double left = sums(delay - step).explained(also_wrong_signs);
    const double middle = sums(delay).explained(also_wrong_signs);
    const double right = sums(delay + step).explained(also_wrong_signs);
    const double bend = left - 2 * middle + right;
    if (bend < 0) delay += std::clamp(0.5 * (left - right) / bend, -1.0, 1.0) * step;
  }
  return delay;
}

double Comparison::accuracy(double delay, double step) const {
  const Sums there = sums(delay);
  double change = 0;
  for (const Span& span : spans_) {
    const Turn slope = (tracking(span, delay + step) - tracking(span, delay - step)) / (2 * step);
    for (int axis = 0; axis < 3; ++axis) change += std::pow(there.scale(axis) * slope[axis], 2);
  }
  if (!(change > 0)) return std::numeric_limits<double>::infinity();
  const double left = there.picture_squares().sum() * (1 - there.explained(true));
  return std::sqrt(left / static_cast<double>(3 * spans_.size()) / change);
}

}  // namespace trk_bridge::delay
