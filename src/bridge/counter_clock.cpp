// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "counter_clock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stamper.h"

namespace trk_bridge::bridge {
namespace {

// All times in ns.
constexpr double millisecond = 1e6, second = 1e9;

constexpr double line_memory = 30 * second;  // of the fitted line
constexpr double jitter_memory = 120 * second;
constexpr double recent = 2 * second;           // of recent_error_, recent_outliers_
constexpr double closes_gap_in = 1.5 * second;  // time constant
constexpr double hand_over = 2 * second;        // from arrivals to the line
constexpr double offset_settles_in = 1 * second;
constexpr double settles_in =
    10 * second;  // after a step; a second one to the same side within this time means a wrong rate
constexpr double least_samples = 16;
constexpr double most_jitter = 0.5;  // of an interval
constexpr double least_interval = 1e3;

// In standard deviations of the jitter.
constexpr double edge = 3.3;  // 1 of 2000 normally distributed arrivals is earlier
constexpr double outlier = 5, least_outlier = 0.2 * millisecond;
constexpr double visible_step = 0.6, least_step = 0.05 * millisecond;
/// In standard deviations of the mean over the last seconds.
constexpr double visible_means = 8;
/// Outliers are clipped to this share of `outlier` in that mean.
constexpr double recent_clip = 0.6;
/// Standard deviation over mean absolute deviation of a normal distribution.
constexpr double to_sigma = 1.2533;

/// A larger share of outliers means that the jitter has changed.
constexpr double most_outliers = 0.4;
/// Late samples for longer than this are a step, because a stall ends in a burst. Early samples are a step at once.
constexpr double longest_run = 0.3 * second;
constexpr double least_run = 8;  // samples

constexpr std::array<StandardRate, 13> standard_rates{{{"23.976", 24000 / 1001.0},
                                                       {"24", 24},
                                                       {"25", 25},
                                                       {"29.97", 30000 / 1001.0},
                                                       {"30", 30},
                                                       {"47.952", 48000 / 1001.0},
                                                       {"48", 48},
                                                       {"50", 50},
                                                       {"59.94", 60000 / 1001.0},
                                                       {"60", 60},
                                                       {"100", 100},
                                                       {"119.88", 120000 / 1001.0},
                                                       {"120", 120}}};
constexpr double rate_tolerance = 300e-6;

}  // namespace

const StandardRate* standard_rate(double rate) noexcept {
  const auto found = std::find_if(standard_rates.begin(), standard_rates.end(), [rate](const StandardRate& standard) {
    return std::abs(rate / standard.rate - 1) < rate_tolerance;
  });
  return found == standard_rates.end() ? nullptr : &*found;
}

void CounterClock::forget() noexcept {
  samples_ = 0;
  statistics_.learned = false;
  statistics_.interval = statistics_.jitter_before = statistics_.jitter_after = 0;
}

std::int64_t CounterClock::stamp(std::uint64_t counts, std::int64_t arrival) noexcept {
  const auto elapsed = static_cast<double>(arrival - arrival_);
  arrival_ = arrival;
  if (samples_ == 0) {
    begin();
  } else {
    line_ -= elapsed;
    follow(static_cast<double>(counts), elapsed);
  }
  const std::int64_t wanted = arrival - std::llround(before_arrival());
  newest_ = std::min(std::max(wanted, newest_ + Stamper::least_step), arrival);
  return newest_;
}

void CounterClock::begin() noexcept {
  samples_ = offset_samples_ = 1;
  line_ = age_ = gap_ = 0;
  deviation_ = deviations_ = recent_error_ = recent_outliers_ = 0;
  run_ = {};
  since_step_ = settles_in;
  statistics_.learned = false;
}

void CounterClock::follow(double counts, double elapsed) noexcept {
  age_ += std::max(elapsed, 0.0);
  since_step_ += std::max(elapsed, 0.0);
  if (samples_ < 2) {
    if (counts == 0 || elapsed <= 0) return begin();
    interval_ = elapsed / counts;
  }
  if (counts == 0 || std::abs(line_ + counts * interval_) > most_early) {
    if (!statistics_.learned) return begin();
    ++statistics_.restarts;
    counts = std::round(-line_ / interval_);
    line_ += counts * interval_;
    if (std::abs(line_) > outlier_limit()) return resume();
    counts = std::max(counts, 1.0);
  } else {
    line_ += counts * interval_;
  }
  const double error = -line_;
  const bool is_outlier =
      samples_ >= least_samples && offset_samples_ >= least_run && std::abs(error) > outlier_limit();
  note(error, counts, elapsed, is_outlier);
  if (!is_outlier) correct(error, counts);
  if (has_stepped()) return step();
  if (to_sigma * deviation_ > most_jitter * interval_) {  // the samples have no rhythm
    age_ = 0;
    statistics_.learned = false;
  }
  if (samples_ >= least_samples && age_ >= learning) {
    statistics_.learned = true;
    statistics_.interval = interval_;
  }
}

/// Keeps the interval, which may still be right.
void CounterClock::resume() noexcept {
  move_line(-line_, 1);
  gap_ = 0;
  age_ = 0;
  since_step_ = settles_in;
  statistics_.learned = false;
}

double CounterClock::outlier_limit() const noexcept { return std::max(outlier * to_sigma * deviation_, least_outlier); }

void CounterClock::note(double error, double counts, double elapsed, bool is_outlier) noexcept {
  const double passed = counts * interval_;
  const double clipped = std::clamp(error, -outlier_limit(), outlier_limit());
  gap_ -= gap_ * std::min(1.0, passed / closes_gap_in);

  const double weight = std::min(1.0, passed / recent);
  recent_outliers_ += ((is_outlier ? 1.0 : 0.0) - recent_outliers_) * weight;
  // Samples that a stall held back arrive together when it ends. They do not show the delay of the path.
  const bool was_held_back = is_outlier && elapsed < passed / 2;
  if (samples_ >= least_samples && since_step_ > offset_settles_in && !was_held_back) {
    const double most = outlier_limit() * recent_clip;
    recent_error_ += (std::clamp(error, -most, most) - recent_error_) * weight;
  }

  if (!is_outlier) {
    run_ = {};
  } else {
    ++statistics_.outliers;
    if (run_.samples == 0 || (run_.errors > 0) != (error > 0)) {
      run_ = {1, 0, error, counts};
    } else {
      ++run_.samples;
      run_.errors += error;
      run_.span += elapsed;
    }
  }

  const bool another_jitter = recent_outliers_ > most_outliers;
  if (is_outlier && !another_jitter) return;
  const double most = another_jitter ? 4 * least_samples : jitter_memory / interval_;
  deviations_ = std::min(deviations_ + 1, std::max(most, least_samples));
  // The prediction error of a line through k samples, one sample ahead, is larger than the error of a sample.
  const double k = samples_;
  const double of_line = samples_ < least_samples ? std::abs(error) : std::abs(clipped);
  deviation_ += (of_line / std::sqrt(1 + (4 * k + 2) / (k * (k - 1))) - deviation_) / deviations_;
}

void CounterClock::correct(double error, double counts) noexcept {
  ++samples_;
  ++offset_samples_;
  const double k = samples_;
  const double lambda = std::exp(-counts * interval_ / line_memory);
  const double alpha = std::max({2 * (2 * k - 1) / (k * (k + 1)), 1 - lambda * lambda, 1 / offset_samples_});
  const double beta = std::max(6 / (k * (k + 1)), (1 - lambda) * (1 - lambda));
  line_ += alpha * error;
  interval_ = std::max(interval_ + beta * error / counts, least_interval);
  if (since_step_ < settles_in && offset_samples_ < samples_) gap_ -= alpha * error;
  statistics_.jitter_before = to_sigma * deviation_;
  statistics_.jitter_after = statistics_.jitter_before * std::sqrt(alpha);
}

bool CounterClock::is_long_run() const noexcept {
  return run_.samples >= least_run && (run_.errors < 0 || run_.span > longest_run);
}

bool CounterClock::has_stepped() const noexcept {
  if (is_long_run()) return true;
  const double sigma = to_sigma * deviation_;
  const double sigma_of_mean = sigma * std::sqrt(interval_ / (2 * recent));
  // If jitter reorders samples, the errors of the remaining samples are correlated.
  const double of_order = sigma * sigma / interval_;
  const double visible = std::max({visible_step * sigma, visible_means * sigma_of_mean, of_order, least_step});
  return samples_ >= 2 * least_samples && age_ > second && std::abs(recent_error_) > visible;
}

void CounterClock::step() noexcept {
  const bool is_run = run_.samples >= least_run;
  const double by = is_run ? run_.errors / run_.samples : recent_error_;
  const double jumped = std::round(-by / interval_);
  if (is_run && jumped >= 1 && jumped < run_.first_counts && std::abs(by + jumped * interval_) < outlier_limit() / 2) {
    ++statistics_.restarts;
    line_ -= jumped * interval_;
    recent_error_ = recent_outliers_ = 0;
    run_ = {};
    return;
  }
  if (since_step_ < settles_in && (statistics_.last_step > 0) == (by > 0)) {
    --statistics_.steps;  // it was not a step
    ++statistics_.rate_changes;
    return begin();
  }
  ++statistics_.steps;
  statistics_.last_step = by;
  since_step_ = 0;
  move_line(by, is_run ? run_.samples : 1);
}

void CounterClock::move_line(double by, double samples) noexcept {
  line_ += by;
  gap_ -= by;
  offset_samples_ = samples;
  recent_error_ = recent_outliers_ = 0;
  run_ = {};
}

double CounterClock::before_arrival() const noexcept {
  if (!statistics_.learned) return 0;
  const double share = std::min((age_ - learning) / hand_over, 1.0);
  return std::clamp(share * (edge * to_sigma * deviation_ - line_ - gap_), 0.0, most_early);
}

}  // namespace trk_bridge::bridge
