// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/stamper.h"

#include <limits>
#include <vector>

#include <gmock/gmock.h>

namespace trk_bridge::bridge::stamper_test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t today = 1'700'000'000 * second + 123'456'789;

/// As ros::Time::toSec() does.
double to_seconds(std::int64_t stamp) {
  return static_cast<double>(stamp / second) + 1e-9 * static_cast<double>(stamp % second);
}

TEST(Stamper, IsArrivalMinusDelayToTheNanosecond) {
  Stamper stamper(milliseconds(40));
  EXPECT_EQ(stamper.stamp(today), 1'700'000'000 * second + 83'456'789);
  EXPECT_EQ(stamper.stamp(today + 20'000'000), 1'700'000'000 * second + 103'456'789);
  EXPECT_EQ(stamper.held(), 0u);
}

TEST(Stamper, StrictlyIncreasesIfTheClockStopsOrStepsBack) {
  Stamper stamper(nanoseconds(0));
  std::vector<std::int64_t> stamps;
  for (const std::int64_t offset : {0L, 0L, -second / 2, -second / 4, 1L, 2000L, second}) {
    const auto stamp = stamper.stamp(today + offset);
    ASSERT_TRUE(stamp);
    if (!stamps.empty()) {
      EXPECT_GT(*stamp, stamps.back());
      EXPECT_GT(to_seconds(*stamp), to_seconds(stamps.back())) << "must differ as doubles, too";
    }
    stamps.push_back(*stamp);
  }
  // When the clock has caught up, stamps are the arrivals again.
  EXPECT_EQ(stamps.back(), today + second);
  EXPECT_EQ(stamper.ahead(), 0);
  EXPECT_EQ(stamper.held(), 5u);
}

TEST(Stamper, ReportsHowFarItIsAhead) {
  Stamper stamper(nanoseconds(0));
  ASSERT_TRUE(stamper.stamp(today));
  ASSERT_TRUE(stamper.stamp(today - second / 2));
  EXPECT_EQ(stamper.ahead(), second / 2 + Stamper::least_step);
}

TEST(Stamper, FollowsAClockThatStepsBackByMoreThanASecond) {
  Stamper stamper(milliseconds(40));
  // The clock is an hour ahead for a second.
  ASSERT_TRUE(stamper.stamp(today));
  for (int i = 1; i <= 50; ++i) ASSERT_TRUE(stamper.stamp(today + 3600 * second + i * second / 50));
  EXPECT_EQ(stamper.stamp(today + second), today + second - 40'000'000) << "true at once";
  EXPECT_EQ(stamper.stamp(today + 2 * second), today + 2 * second - 40'000'000);
  EXPECT_EQ(stamper.ahead(), 0);
  EXPECT_EQ(stamper.held(), 0u);
  EXPECT_EQ(stamper.steps(), 1u);
  EXPECT_EQ(stamper.last_step(), 3600 * second);
}

TEST(Stamper, RefusesTimesOutsideOfRosTimeAndContinues) {
  Stamper stamper(milliseconds(5));
  EXPECT_FALSE(stamper.stamp(-1));
  EXPECT_FALSE(stamper.stamp(0));
  EXPECT_FALSE(stamper.stamp(4'000'000)) << "before 1970 after the delay is subtracted";
  EXPECT_FALSE(stamper.stamp(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(stamper.stamp(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(stamper.stamp(today), today - 5'000'000);
}

TEST(Stamper, EndsWithRosTime) {
  constexpr std::int64_t last = 4'294'967'295 * second + 999'999'999;
  Stamper stamper(nanoseconds(0));
  EXPECT_EQ(stamper.stamp(last), last);
  EXPECT_FALSE(stamper.stamp(last)) << "nothing later can be a stamp";
}

TEST(Stamper, UnorderedIsArrivalMinusDelayWhateverCameBefore) {
  Stamper stamper(milliseconds(5));
  ASSERT_TRUE(stamper.stamp(today));
  EXPECT_EQ(stamper.unordered(today - second), today - second - 5'000'000);
  EXPECT_EQ(stamper.unordered(4'000'000), 0) << "before 1970 after the delay is subtracted";
  EXPECT_EQ(stamper.unordered(std::numeric_limits<std::int64_t>::max()), 0);
  EXPECT_EQ(stamper.unordered(std::numeric_limits<std::int64_t>::min()), 0);
  EXPECT_EQ(stamper.held(), 0u);
}

}  // namespace trk_bridge::bridge::stamper_test
