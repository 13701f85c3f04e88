// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "cadence.h"

#include <algorithm>
#include <cmath>

namespace trk_bridge::shm {
namespace {

/// CPU time in ns to fall asleep and wake up: limits of plausible values.
constexpr double least_sleep_cost = 5'000;
constexpr double most_sleep_cost = 60'000;
/// CPU time in ns: the largest credit and the largest debt.
constexpr double most_credit = 500'000;
constexpr double most_debt = 20'000;
constexpr double most_learning_credit = 8'000'000;
/// ns: shorter sleeps are not useful.
constexpr double shortest_sleep = 60'000;
/// ns between polls while the period is unknown.
constexpr double learning_sleep = 250'000;
/// ns: only longer sleeps are used to measure how late a sleep ends.
constexpr double long_sleep = 1'000'000;
constexpr double longest_lateness = 400'000;
/// After this many expected times without a set, the period is unknown again.
constexpr int most_missed = 8;
/// This many sets in a row at an unexpected time mean that the writer has shifted.
constexpr int most_outliers = 2;
/// Sets before one can count as an outlier.
constexpr unsigned first_sets = 4;
/// Polling is continuous within this many mean deviations around the expected time.
constexpr double window = 3;
constexpr double least_deviation = 5'000;

}  // namespace

Cadence::Cadence(std::int64_t now) noexcept
    : last_poll_(now), last_found_(now), credit_(most_credit), learning_credit_(most_learning_credit) {}

void Cadence::polled(std::int64_t now, unsigned sets) noexcept {
  pay(now);
  expected_ -= static_cast<double>(now - last_poll_);
  if (sets > 0) {
    found(now, sets);
  } else if (is_known() && -expected_ > period_ / 2) {
    expected_ += period_;
    if (++missed_ > most_missed) forget();
  }
  last_poll_ = now;
  before_ = Before::nothing;
}

void Cadence::slept(std::int64_t cost) noexcept {
  const double counted = std::clamp(static_cast<double>(cost), least_sleep_cost, most_sleep_cost);
  sleep_cost_ += (counted - sleep_cost_) / 16;
  cost_ += counted;
}

void Cadence::pay(std::int64_t now) noexcept {
  const auto since = static_cast<double>(now - last_poll_);
  const double cost = before_ == Before::nothing ? std::min(since, sleep_cost_) : cost_;
  cost_ = 0;
  if (is_known() || learning_credit_ < sleep_cost_) {
    credit_ -= cost;
  } else {
    learning_credit_ -= cost;
  }
  credit_ = std::clamp(credit_ + share * since, -most_debt, most_credit);
  learning_credit_ = std::min(learning_credit_ + share * since, most_learning_credit);
  // A sleep may have ended early.
  if (before_ != Before::sleep || now < planned_) return;
  const double late = std::clamp(static_cast<double>(now - planned_), 0.0, longest_lateness);
  late_ += (late - late_) / 16;
  late_deviation_ += (std::abs(late - late_) - late_deviation_) / 16;
}

void Cadence::found(std::int64_t now, unsigned sets) noexcept {
  const auto since = static_cast<double>(now - last_poll_);
  if (!is_known()) return learn(now, sets);
  const bool is_faster = missed_ == 0 && since < (sets - 1) * period_ - 4 * deviation_;
  if (is_faster) {
    forget();
    return learn(now, sets);
  }
  missed_ = 0;
  // It was written after the previous poll; any expected time within this interval is right.
  const double expected = expected_ + (sets - 1) * period_;
  double error = std::clamp(expected, -since, 0.0) - expected;
  const double written = expected + error;
  const double interval = written + static_cast<double>(now - last_found_);
  const double periods = std::max(std::round(interval / period_), static_cast<double>(sets));
  error -= period_ * std::round(error / period_);
  // Found after a sleep beyond the expected time: it may have been written long before.
  if (error == 0 && before_ == Before::sleep) error = -deviation_ / 4;
  const bool is_outlier = std::abs(error) > 4 * deviation_ && tracked_ >= first_sets;
  outliers_ = is_outlier ? outliers_ + 1 : 0;
  if (outliers_ == most_outliers && std::abs(error) > period_ / 4) return forget();
  tracked_ = std::min(tracked_ + 1, 32U);
  const double counted = is_outlier ? 4 * deviation_ : std::abs(error);
  deviation_ += (counted - deviation_) / std::min(tracked_ + 1, 16U);
  deviation_ = std::clamp(deviation_, least_deviation, period_ / 4);
  // A single outlier was delayed; the next sets come as before. With the second one, the writer has shifted. Otherwise,
  // correct by half of the error: writers with a steady clock need no correction, but those that sleep between sets do.
  const double moved = !is_outlier ? written - error / 2 : outliers_ < most_outliers ? written - error : written;
  if (!is_outlier) period_ += (interval / periods - period_) / (tracked_ + 1);
  if (period_ < shortest_sleep) return forget();
  if (outliers_ == most_outliers) outliers_ = 0;
  last_found_ = now + static_cast<std::int64_t>(is_outlier ? moved : written);
  expected_ = moved + period_;
}

// Uses two intervals: their mean is the period even if two writers alternate.
void Cadence::learn(std::int64_t now, unsigned sets) noexcept {
  const double half = static_cast<double>(now - last_poll_) / 2;
  const auto written = now - static_cast<std::int64_t>(half);
  const double interval = static_cast<double>(written - last_found_) / sets;
  const double uncertainty = std::max(half, least_deviation);
  const bool is_exact = has_found_ && uncertainty + uncertainty_ < interval / 2;
  if (is_exact && interval_ > 0 && interval + interval_ > 2 * shortest_sleep) {
    period_ = (interval + interval_) / 2;
    deviation_ = std::min(std::abs(interval - interval_) / 2 + uncertainty, period_ / 4);
    expected_ = period_ - half;
    tracked_ = 0;
    outliers_ = missed_ = 0;
  }
  interval_ = is_exact ? interval : 0;
  is_fast_ = interval < 2 * affordable_sleep();
  has_found_ = true;
  uncertainty_ = uncertainty;
  last_found_ = written;
}

void Cadence::forget() noexcept {
  period_ = 0;
  has_found_ = false;
  interval_ = 0;
  outliers_ = missed_ = 0;
}

double Cadence::sleep_while_unknown(std::int64_t now) noexcept {
  // Without credit for this, sets of a fast writer would be replaced before they are read.
  const double least = is_fast_ || learning_credit_ >= sleep_cost_ ? learning_sleep : affordable_sleep();
  return std::clamp(static_cast<double>(now - last_found_) / 16, least, static_cast<double>(slowest));
}

std::int64_t Cadence::next(std::int64_t now) noexcept {
  double sleep = 0;
  if (!is_known()) {
    sleep = sleep_while_unknown(now);
  } else {
    const double ahead = expected_ - static_cast<double>(now - last_poll_);
    const double end = ahead + window * deviation_;
    const bool can_pay = credit_ >= sleep_cost_;
    const double begin = (can_pay ? ahead - window * deviation_ - 2 * late_deviation_ : ahead + 2 * deviation_) - late_;
    if (begin > shortest_sleep) {
      sleep = begin;
    } else if (end > 0) {
      if (credit_ < end) sleep = std::max(shortest_sleep, end * sleep_cost_ / std::max(credit_, sleep_cost_));
    } else {
      const double next_begin = ahead + period_ - window * deviation_ - 2 * late_deviation_ - late_;
      sleep = can_pay ? -ahead / 4 : std::min({-ahead, affordable_sleep(), period_ / 4});
      sleep = std::max(std::min(sleep, next_begin), shortest_sleep);
    }
  }
  before_ = sleep == 0 ? Before::nothing : sleep < long_sleep ? Before::short_sleep : Before::sleep;
  planned_ = now + std::min(static_cast<std::int64_t>(sleep), slowest);
  return planned_;
}

}  // namespace trk_bridge::shm
