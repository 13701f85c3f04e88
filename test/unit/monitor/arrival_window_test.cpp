// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/arrival_window.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace trk_bridge::monitor::arrival_window_test {

constexpr std::int64_t ms = 1'000'000;

TEST(ArrivalWindow, ReportsNothingForTooFewRecords) {
  ArrivalWindow window;
  EXPECT_FALSE(window.rate());
  window.add(0);
  EXPECT_FALSE(window.rate());
  window.add(20 * ms);
  EXPECT_DOUBLE_EQ(window.rate().value(), 50);
  EXPECT_FALSE(window.jitter());
  window.add(40 * ms);
  EXPECT_TRUE(window.jitter());
}

TEST(ArrivalWindow, AllAtOnceHaveNoRate) {
  ArrivalWindow window;
  for (int i = 0; i < 5; ++i) window.add(7);
  EXPECT_FALSE(window.rate());
  EXPECT_EQ(window.jitter().value().worst, 0);
}

TEST(ArrivalWindow, JitterIsTheDistanceFromTheMedianInterval) {
  ArrivalWindow window;
  // Intervals of 20 ms except for a late one of 25 ms, after which the next one is short.
  for (const std::int64_t at : {0, 20, 40, 65, 80, 100, 120}) window.add(at * ms);
  const auto jitter = window.jitter().value();
  EXPECT_EQ(jitter.interval, 20 * ms);
  EXPECT_EQ(jitter.p50, 0);
  EXPECT_EQ(jitter.p99, 5 * ms);
  EXPECT_EQ(jitter.worst, 5 * ms);
}

TEST(ArrivalWindow, PercentilesAreByNearestRank) {
  ArrivalWindow window;
  // 200 intervals: 150 of 10 ms, then 48 of 11, one of 14, one of 30: deviations 150 x 0, 48 x 1, 4, 20.
  std::int64_t at = 0;
  window.add(at);
  const auto add = [&](int times, std::int64_t interval) {
    for (int i = 0; i < times; ++i) window.add(at += interval * ms);
  };
  add(150, 10);
  add(48, 11);
  add(1, 14);
  add(1, 30);
  const auto jitter = window.jitter().value();
  EXPECT_EQ(jitter.interval, 10 * ms);
  EXPECT_EQ(jitter.p50, 0);
  EXPECT_EQ(jitter.p99, 1 * ms);  // rank 198 of 200
  EXPECT_EQ(jitter.worst, 20 * ms);
}

TEST(ArrivalWindow, RecordsOlderThanTenSecondsAreRemoved) {
  ArrivalWindow window;
  window.add(0);
  window.add(100 * ms);
  window.add(900 * ms);  // very late
  for (std::int64_t at = 1000; at <= 11'000; at += 100) window.add(at * ms);
  EXPECT_EQ(window.jitter().value().worst, 0);
  EXPECT_DOUBLE_EQ(window.rate().value(), 10);
}

TEST(ArrivalWindow, HasALimitedSize) {
  ArrivalWindow window;
  window.add(0);
  window.add(500'000);  // a different interval, which must be removed
  for (std::int64_t i = 1; i <= 4001; ++i) window.add(500'000 + i * 1000);
  EXPECT_EQ(window.jitter().value().worst, 0);
}

TEST(ArrivalWindow, RestartsWhenTheClockIsSetBack) {
  ArrivalWindow window;
  for (const std::int64_t at : {1000, 1020, 1100}) window.add(at * ms);
  window.add(5 * ms);
  EXPECT_FALSE(window.rate());
  window.add(25 * ms);
  window.add(45 * ms);
  EXPECT_DOUBLE_EQ(window.rate().value(), 50);
  EXPECT_EQ(window.jitter().value().worst, 0);
}

}  // namespace trk_bridge::monitor::arrival_window_test
