// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "phase_lock.h"

#include <algorithm>
#include <cmath>

namespace trk_bridge::bridge {
namespace {

/// Memory of the filter in samples: 4 s at 50 Hz.
constexpr double filter_memory = 200;
/// After this many consecutive samples that do not fit, the rhythm has changed.
constexpr int most_strays = 10;
/// ns without a sample, after which the rhythm is measured again.
constexpr std::int64_t longest_gap = 1'000'000'000;
/// ns after an expected arrival: the time until a sample is ready.
constexpr double least_wait = 300'000;
/// ns; limited because samples should be sent as new as possible. More jitter than this needs a delay.
constexpr double longest_phase_wait = 800'000;
/// Relative difference of rates that count as equal.
constexpr double tolerance = 0.005;

}  // namespace

PhaseLock::PhaseLock(std::optional<double> rate) noexcept : period_(rate ? 1e9 / *rate : 0) {}

void PhaseLock::arrive(std::int64_t now) noexcept {
  if (!last_ || now - *last_ > longest_gap) {
    departure_.reset();
    return start_over(now);
  }
  const std::int64_t interval = now - *last_;
  if (!is_known()) return learn(interval);
  const double ahead = static_cast<double>(now - origin_) - phase_;
  const double periods = std::round(ahead / sample_period_);
  const double error = ahead - periods * sample_period_;
  last_ = now;
  // A second sample within one period is not used, nor is one at an odd time.
  if (periods < 1) return;
  if (std::abs(error) > std::max(sample_period_ / 4, 4 * deviation_)) {
    if (++strays_ > most_strays) start_over(now);
    return;
  }
  strays_ = 0;
  correct(periods, error);
}

void PhaseLock::start_over(std::int64_t now) noexcept {
  last_ = origin_ = now;
  phase_ = 0;
  intervals_ = 0;
  samples_ = 0;
  strays_ = 0;
}

void PhaseLock::learn(std::int64_t interval) noexcept {
  if (interval < least_interval) return;
  *last_ += interval;
  origin_ = *last_;
  first_[intervals_++] = interval;
  if (!is_known()) return;
  auto sorted = first_;
  std::sort(sorted.begin(), sorted.end());
  sample_period_ = static_cast<double>(sorted[first_intervals / 2]);
  deviation_ = 0;
  for (const auto one : first_) {
    const double far = std::abs(static_cast<double>(one) - sample_period_);
    deviation_ += std::min(far, sample_period_ / 12) / first_intervals;
  }
}

void PhaseLock::correct(double periods, double error) noexcept {
  // Fading-memory alpha-beta filter, whose memory grows to its length: the first samples count more.
  const auto k = static_cast<double>(++samples_ + first_intervals);
  const double fading = std::exp(-1 / filter_memory);
  const double alpha = std::max(2 * (2 * k - 1) / (k * (k + 1)), 1 - fading * fading);
  const double beta = std::max(6 / (k * (k + 1)), (1 - fading) * (1 - fading));
  // Delays are rare and long: they are clipped, so that the rhythm stays where most samples are.
  const double limit = samples_ < 20 ? std::abs(error) : least_wait / 2 + 2 * deviation_;
  const double counted = std::clamp(error, -limit, limit);
  phase_ += periods * sample_period_ + alpha * counted;
  sample_period_ += beta * counted / periods;
  deviation_ += (std::abs(error) - deviation_) / 64;
  const auto whole = static_cast<std::int64_t>(phase_);
  origin_ += whole;
  phase_ -= static_cast<double>(whole);
}

double PhaseLock::wait() const noexcept {
  return std::min({least_wait + 3 * deviation_, longest_phase_wait, sample_period_ / 4});
}

double PhaseLock::step() const noexcept {
  if (!is_known()) return 0;
  if (period_ == 0) return sample_period_;
  const double ratio = period_ / sample_period_;
  const double whole = std::round(std::max(ratio, 1 / ratio));
  const double locked = ratio >= 1 ? whole * sample_period_ : sample_period_ / whole;
  return std::abs(locked / period_ - 1) <= tolerance ? locked : 0;
}

double PhaseLock::period() const noexcept {
  const double locked = step();
  return locked > 0 ? locked : period_;
}

std::optional<std::int64_t> PhaseLock::next(std::int64_t now) noexcept {
  if (!last_ || period() == 0) return std::nullopt;
  if (!departure_) departure_ = *last_ + static_cast<std::int64_t>(least_wait) - std::llround(period());
  const double step = period();
  // Missed departures are skipped.
  const double missed = std::max(0.0, std::floor(static_cast<double>(now - *departure_) / step));
  auto next = static_cast<double>(*departure_ - origin_) + (1 + missed) * step;
  if (is_locked()) {
    const double grid = std::min(step, sample_period_);
    next += std::remainder(phase_ + wait() - next, grid);
  }
  const auto found = origin_ + std::llround(next);
  departure_ = found > now ? found : found + std::llround(step);
  return departure_;
}

}  // namespace trk_bridge::bridge
