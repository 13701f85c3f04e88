// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/phase_lock.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::bridge::phase_lock_test {

constexpr double ms = 1e6;
constexpr std::int64_t start = 5'000'000'000'000;

/// Samples that arrive, and the departures between them.
struct Run {
  std::vector<std::int64_t> arrivals, departures;

  double count() const { return static_cast<double>(departures.size()); }
  /// Age (ns) of the newest arrival at each departure from `begin` (ns) on.
  std::vector<double> ages(double begin) const {
    std::vector<double> ages;
    for (const auto departure : departures) {
      if (static_cast<double>(departure - start) < begin) continue;
      const auto newer = std::upper_bound(arrivals.begin(), arrivals.end(), departure);
      ages.push_back(static_cast<double>(departure - *(newer - 1)));
    }
    return ages;
  }
  /// ns between departures from `begin` on.
  std::vector<double> intervals(double begin) const {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < departures.size(); ++i) {
      if (static_cast<double>(departures[i - 1] - start) < begin) continue;
      intervals.push_back(static_cast<double>(departures[i] - departures[i - 1]));
    }
    return intervals;
  }
};

Run run(PhaseLock& lock, std::vector<std::int64_t> arrivals) {
  std::sort(arrivals.begin(), arrivals.end());
  Run run{arrivals, {}};
  std::optional<std::int64_t> due;
  for (const auto arrival : arrivals) {
    while (due && *due < arrival) {
      run.departures.push_back(*due);
      due = lock.next(*due);
    }
    lock.arrive(arrival);
    if (!due) due = lock.next(arrival);
  }
  return run;
}

/// `count` arrivals at this rate (Hz), each delayed by a value of `jitter` (ns).
std::vector<std::int64_t> arrivals_at(
    double rate, int count, const std::function<double()>& jitter = [] { return 0.0; }) {
  std::vector<std::int64_t> arrivals;
  for (int i = 0; i < count; ++i) arrivals.push_back(start + std::llround(i * 1e9 / rate + jitter()));
  return arrivals;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double smallest(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

TEST(PhaseLock, DeparturesFollowEvenSamplesOfTheirRate) {
  for (const double rate : {50.0, 50.0 * 1.001, 50 / 1.001}) {
    PhaseLock lock(50);
    const auto done = run(lock, arrivals_at(rate, 500));
    EXPECT_GT(smallest(done.ages(1e9)), 0.2 * ms) << rate;
    EXPECT_LT(largest(done.ages(1e9)), 1 * ms) << rate;
    EXPECT_NEAR(done.count(), 500, 3);
  }
}

TEST(PhaseLock, WithoutARateItUsesThatOfTheSamples) {
  for (const double rate : {24 / 1.001, 50.0, 60 / 1.001, 120 / 1.001}) {
    PhaseLock lock;
    EXPECT_FALSE(lock.next(start)) << "not known yet";
    const auto done = run(lock, arrivals_at(rate, 1000));
    EXPECT_NEAR(lock.period(), 1e9 / rate, 1e9 / rate * 1e-5);
    EXPECT_LT(largest(done.ages(1e9)), 1 * ms) << rate;
    EXPECT_NEAR(done.count(), 995, 2);
  }
}

/// Every second sample, always with the same phase; or two departures per sample.
TEST(PhaseLock, OneRateMayBeAMultipleOfTheOther) {
  PhaseLock half(50);
  const auto every_second = run(half, arrivals_at(100, 1000));
  EXPECT_LT(largest(every_second.ages(1e9)), 1 * ms);
  EXPECT_NEAR(every_second.count(), 500, 3);
  PhaseLock twice(50);
  const auto two_a_sample = run(twice, arrivals_at(25, 250));
  EXPECT_NEAR(two_a_sample.count(), 500, 5);
  for (const double age : two_a_sample.ages(2e9)) EXPECT_NEAR(std::remainder(age, 20 * ms), 0.5 * ms, 0.5 * ms);
}

TEST(PhaseLock, RatesThatAreNotMultiplesAreIndependent) {
  PhaseLock lock(50);
  const auto done = run(lock, arrivals_at(60, 600));
  EXPECT_FALSE(lock.is_locked());
  EXPECT_NEAR(done.count(), 500, 2);
  EXPECT_NEAR(largest(done.intervals(1e9)), 20 * ms, 10);
}

/// Departures have the period of the samples, not of their arrivals, just after most of the arrivals.
TEST(PhaseLock, JitterBecomesAnEvenRhythmAfterTheSamples) {
  std::mt19937 random(7);
  std::normal_distribution<double> gauss(5 * ms, 1 * ms);
  std::exponential_distribution<double> exponential(1 / (1 * ms));
  for (const std::function<double()>& jitter : {std::function<double()>([&] { return gauss(random); }),
                                                std::function<double()>([&] { return exponential(random); })}) {
    PhaseLock lock(50);
    const auto done = run(lock, arrivals_at(50, 3000, jitter));
    auto intervals = done.intervals(10e9);
    for (auto& interval : intervals) interval = std::abs(interval - 20 * ms);
    std::sort(intervals.begin(), intervals.end());
    EXPECT_LT(intervals[intervals.size() * 99 / 100], 0.3 * ms);
    const auto ages = done.ages(10e9);
    const auto late = std::count_if(ages.begin(), ages.end(), [](double age) { return age > 10 * ms; });
    EXPECT_LT(static_cast<double>(late), 0.3 * static_cast<double>(ages.size()));
  }
}

/// A busy machine delays one of ten samples by 4 ms; the others are not sent later because of that.
TEST(PhaseLock, RareDelaysDoNotDelayTheOthers) {
  std::mt19937 random(7);
  std::bernoulli_distribution is_held(0.1);
  PhaseLock lock(50);
  const auto done = run(lock, arrivals_at(50, 3000, [&] { return is_held(random) ? 4 * ms : 0; }));
  auto ages = done.ages(4e9);
  std::sort(ages.begin(), ages.end());
  EXPECT_LT(ages[ages.size() / 2], 1.2 * ms);
}

TEST(PhaseLock, LossBurstsAndStallsDoNotMoveIt) {
  auto arrivals = arrivals_at(50, 1500);
  for (std::size_t i = 200; i < arrivals.size(); i += 100) {
    // Nothing for 150 ms, and then all of it.
    for (std::size_t k = 0; k < 8; ++k) arrivals[i + k] = arrivals[i + 7] + static_cast<std::int64_t>(k) * 20'000;
    arrivals[i + 40] = arrivals[i + 41];
  }
  PhaseLock lock(50);
  const auto done = run(lock, arrivals);
  for (const double interval : done.intervals(1e9)) EXPECT_NEAR(interval, 20 * ms, 0.3 * ms);
}

TEST(PhaseLock, AdaptsToAnotherPhaseWithinHalfASecond) {
  auto arrivals = arrivals_at(50, 1000);
  for (std::size_t i = 500; i < arrivals.size(); ++i) arrivals[i] += 9'000'000;
  PhaseLock lock(50);
  const auto done = run(lock, arrivals);
  EXPECT_LT(largest(done.ages(10.6e9)), 1 * ms);
}

TEST(PhaseLock, AfterAPauseItStartsAgain) {
  auto arrivals = arrivals_at(50, 1000);
  for (std::size_t i = 500; i < arrivals.size(); ++i) arrivals[i] += 5'007'000'000;
  PhaseLock lock(50);
  const auto done = run(lock, arrivals);
  EXPECT_LT(largest(done.ages(15.3e9)), 1 * ms);
}

}  // namespace trk_bridge::bridge::phase_lock_test
