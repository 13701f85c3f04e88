// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// When a reader polls a writer that wakes no readers, in simulated time: writers, sleeps and costs are models of the
// test.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "shm/cadence.h"

namespace trk_bridge::shm::cadence_test {

constexpr double us = 1e3, ms = 1e6, s = 1e9;

/// The results of a reader that polled at the computed times; the writer wrote at these times (ns).
struct Met {
  std::vector<double> lateness;  // ns, of the sets that were found
  int replaced = 0;              // written and replaced before they were seen
  int looks = 0;
  double cpu = 0;  // ns
  double seconds = 0;

  double quantile(double part) {
    std::sort(lateness.begin(), lateness.end());
    return lateness.at(static_cast<std::size_t>(part * static_cast<double>(lateness.size() - 1)));
  }
  double share() const { return cpu / (seconds * s); }
};

/// Counted from `from` on. A sleep ends 45 to 110 us late and takes 20 us of CPU time, measured on a small virtual
/// machine; a poll without a sleep takes 1 us.
Met read(const std::vector<std::int64_t>& written, double from = 2 * s) {
  std::mt19937 random(1);
  std::normal_distribution<double> spread(0, 15 * us);
  const auto begin = written.front() - static_cast<std::int64_t>(3 * ms);
  const auto counted_from = begin + static_cast<std::int64_t>(from);
  const auto end = written.back() + static_cast<std::int64_t>(200 * ms);
  Cadence cadence(begin);
  Met met;
  met.seconds = static_cast<double>(end - counted_from) / s;
  std::size_t seen = 0;
  for (std::int64_t now = begin; now < end;) {
    unsigned sets = 0;
    for (; seen < written.size() && written[seen] <= now; ++seen) ++sets;
    const bool counts = now >= counted_from;
    if (sets > 0 && counts) {
      met.lateness.push_back(static_cast<double>(now - written[seen - 1]));
      met.replaced += static_cast<int>(sets) - 1;
    }
    cadence.polled(now, sets);
    const std::int64_t next = cadence.next(now);
    if (next <= now) {
      now += static_cast<std::int64_t>(us);
      met.cpu += counts ? 1 * us : 0;
    } else {
      const double late = (next - now > 1'000'000 ? 75 : 45) * us + std::abs(spread(random));
      now = next + static_cast<std::int64_t>(late);
      constexpr double cost = 20 * us;
      cadence.slept(static_cast<std::int64_t>(cost));
      met.cpu += counts ? cost : 0;
    }
    met.looks += counts ? 1 : 0;
  }
  return met;
}

/// A writer with a clock, whose sets have `jitter` (standard deviation, ns); or one that sleeps after every set, so
/// that the jitter accumulates.
enum class Keeps { clock, intervals };
std::vector<std::int64_t> writes(double rate, double jitter, Keeps keeps, double seconds = 20) {
  std::mt19937 random(7);
  std::normal_distribution<double> spread(0, 1);
  std::vector<std::int64_t> times;
  double at = 1e12;
  for (int i = 0; i < rate * seconds; ++i) {
    at += s / rate;
    const double off = jitter * spread(random);
    if (keeps == Keeps::intervals) at += off;
    times.push_back(static_cast<std::int64_t>(keeps == Keeps::clock ? at + off : at));
  }
  std::sort(times.begin(), times.end());
  return times;
}

class EvenWriter : public ::testing::TestWithParam<std::tuple<double, Keeps>> {};

TEST_P(EvenWriter, is_read_at_once_at_low_cost) {
  const auto [rate, keeps] = GetParam();
  for (const double jitter : {0 * us, 10 * us, 30 * us}) {
    auto met = read(writes(rate, jitter, keeps));
    EXPECT_LE(met.quantile(0.5), 60 * us) << "jitter " << jitter;
    EXPECT_LE(met.quantile(0.99), 400 * us) << "jitter " << jitter;
    EXPECT_LE(met.share(), 0.015) << "jitter " << jitter;
    EXPECT_EQ(met.replaced, 0) << "jitter " << jitter;
  }
}

TEST_P(EvenWriter, that_is_delayed_by_a_scheduling_millisecond_is_read_later_and_not_lost) {
  const auto [rate, keeps] = GetParam();
  for (const double jitter : {300 * us, 1 * ms}) {
    auto met = read(writes(rate, jitter, keeps));
    EXPECT_LE(met.quantile(0.5), 400 * us) << "jitter " << jitter;
    EXPECT_LE(met.quantile(1), 7 * ms) << "jitter " << jitter;
    EXPECT_LE(met.share(), 0.015) << "jitter " << jitter;
    EXPECT_EQ(met.replaced, 0) << "jitter " << jitter;
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, EvenWriter,
                         ::testing::Combine(::testing::Values(25, 50, 59.94, 100, 120),
                                            ::testing::Values(Keeps::clock, Keeps::intervals)));

TEST(Cadence, measures_period_and_jitter) {
  Cadence even(0), uneven(0);
  const auto follow = [](Cadence& cadence, const std::vector<std::int64_t>& written) {
    std::size_t seen = 0;
    for (std::int64_t now = written.front() - 1'000'000; seen < written.size();) {
      unsigned sets = 0;
      for (; seen < written.size() && written[seen] <= now; ++seen) ++sets;
      cadence.polled(now, sets);
      cadence.slept(20'000);
      now = std::max(cadence.next(now), now + 1000);
    }
  };
  follow(even, writes(50, 0, Keeps::clock));
  EXPECT_NEAR(even.period(), 20 * ms, 10 * us);
  EXPECT_LE(even.deviation(), 20 * us);
  follow(uneven, writes(120, 500 * us, Keeps::clock));
  EXPECT_NEAR(uneven.period(), s / 120, 300 * us);
  // The mean deviation of a normal distribution is 0.80 of its standard deviation.
  EXPECT_GT(uneven.deviation(), 200 * us);
  EXPECT_LT(uneven.deviation(), 1 * ms);
}

TEST(Cadence, a_thousand_sets_a_second_are_all_read) {
  auto met = read(writes(1000, 0, Keeps::clock));
  EXPECT_EQ(met.replaced, 0);
  EXPECT_LE(met.quantile(1), 1.2 * ms);
  EXPECT_LE(met.share(), 0.04);
}

TEST(Cadence, a_single_set_that_is_late_does_not_make_the_next_ones_late) {
  auto written = writes(50, 5 * us, Keeps::clock);
  for (std::size_t i = 200; i < written.size(); i += 50) written[i] += static_cast<std::int64_t>(4 * ms);
  auto met = read(written);
  // One in fifty is late.
  EXPECT_LE(met.quantile(0.97), 200 * us);
  EXPECT_EQ(met.replaced, 0);
}

TEST(Cadence, another_rate_is_measured_within_a_few_sets) {
  std::vector<std::int64_t> written;
  double at = 1e12;
  constexpr int changes = 20;
  for (int i = 0; i <= changes; ++i) {
    const double rate = std::vector<double>{50, 120, 60, 25, 100}[static_cast<std::size_t>(i) % 5];
    for (int k = 0; k < rate * 2; ++k) written.push_back(static_cast<std::int64_t>(at += s / rate));
  }
  auto met = read(written);
  EXPECT_LE(met.replaced, 3 * changes);
  EXPECT_LE(met.quantile(0.5), 100 * us);
  EXPECT_LE(met.quantile(0.9), 2.5 * ms);
  EXPECT_LE(met.share(), 0.015);
}

TEST(Cadence, after_a_pause_the_first_set_is_late_by_a_small_part_of_it) {
  for (const double pause : {0.1 * s, 0.5 * s, 1 * s, 10 * s}) {
    auto written = writes(50, 0, Keeps::clock, 5);
    const auto first = written.back() + static_cast<std::int64_t>(pause);
    written.push_back(first);
    auto met = read(written, 4 * s);
    EXPECT_LE(met.quantile(1), std::min(pause / 12, 100.3 * ms)) << "pause " << pause / s;
  }
}

TEST(Cadence, a_writer_that_stopped_is_polled_ten_times_a_second) {
  const auto written = std::vector<std::int64_t>{1'000'000'000'000, 1'060'000'000'000};
  const auto met = read(written, 10 * s);
  EXPECT_LE(met.looks, 10 * met.seconds + 30) << "with those after the second set";
  EXPECT_GE(met.looks, 9 * met.seconds);
}

TEST(Cadence, at_any_rate_there_is_polling) {
  for (const double rate : {0.1, 1.0, 5.0, 5000.0, 50000.0}) {
    const auto met = read(writes(rate, 0, Keeps::clock, rate < 1 ? 100 : 10));
    EXPECT_GE(met.looks, 9 * met.seconds) << rate;
    EXPECT_LE(met.share(), rate < 1000 ? 0.015 : 0.1) << rate;
  }
}

TEST(Cadence, two_writers_are_both_read) {
  std::vector<std::int64_t> written;
  for (std::int64_t i = 0; i < 1000; ++i) {
    written.push_back(1'000'000'000'000 + i * 20'000'000);
    written.push_back(1'000'000'000'000 + i * 20'000'000 + 7'000'000);
  }
  auto met = read(written);
  EXPECT_EQ(met.replaced, 0);
  EXPECT_LE(met.quantile(0.5), 2 * ms);
  EXPECT_LE(met.share(), 0.015);
}

TEST(Cadence, sets_without_any_rhythm_cost_no_more) {
  std::mt19937 random(3);
  std::exponential_distribution<double> wait(50);
  std::vector<std::int64_t> written;
  for (double at = 1e12; written.size() < 2000;) written.push_back(static_cast<std::int64_t>(at += s * wait(random)));
  auto met = read(written);
  EXPECT_LE(met.share(), 0.03);
  EXPECT_LE(met.quantile(0.5), 3 * ms);
  // The next one comes within 2 ms in a tenth of all cases.
  EXPECT_LE(met.replaced, 300);
}

}  // namespace trk_bridge::shm::cadence_test
