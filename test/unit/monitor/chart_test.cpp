// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/chart.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::monitor::chart_test {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t ms = 1'000'000;

Range at(double value) { return {value, value}; }

TEST(Curve, RisesFromTheLowestDotToTheHighest) {
  EXPECT_THAT(curve({at(0), at(1), at(2), at(3), {0, 3}, {}}, 2, 1, 0.1),
              ElementsAre("       3.0   .': ", "       0.0 .'  : "));
}

TEST(Curve, OfOneValueIsInTheMiddleOfTheSmallestRange) {
  EXPECT_THAT(curve({at(5), at(5)}, 2, 1, 2), ElementsAre("       6.0 ..", "       4.0   "));
}

TEST(Curve, OfNothingIsEmpty) {
  EXPECT_THAT(curve(std::vector<Range>(3), 2, 1, 1), Each(std::string(scale_width + 3, ' ')));
  EXPECT_THAT(curve({}, 2, 1, 1), SizeIs(2));
  EXPECT_THAT(curve({at(1)}, 0, 1, 1), IsEmpty());
}

TEST(Histogram, CountsEveryIntervalOnce) {
  std::vector<std::int64_t> intervals(30, 20 * ms);
  intervals.insert(intervals.end(), 15, 22 * ms);
  intervals.push_back(23 * ms);
  EXPECT_THAT(histogram(intervals, 3, 28),
              ElementsAre("   20.50 ms    30 ##########", "   21.50 ms     0 ", "   22.50 ms    16 #####"));
  EXPECT_THAT(histogram(intervals, 4, 28), SizeIs(3)) << "an odd number";
  EXPECT_THAT(histogram(intervals, 100, 28), SizeIs(15));
  EXPECT_THAT(histogram({}, 4, 28), IsEmpty());
  for (const auto& line : histogram(intervals, 4, 9)) EXPECT_LE(line.size(), 9U);
}

TEST(Histogram, OneLongIntervalDoesNotHideTheOthers) {
  std::vector<std::int64_t> intervals(30, 20 * ms);
  intervals.insert(intervals.end(), 10, 30 * ms);
  intervals.push_back(5000 * ms);
  EXPECT_THAT(histogram(intervals, 5, 18), ElementsAre("   24.00 ms    30 ", "   32.00 ms    10 ", "   40.00 ms     0 ",
                                                       "   48.00 ms     0 ", "   56.00+ms     1 "));
}

TEST(Histogram, OfEqualIntervalsIsInTheMiddle) {
  EXPECT_THAT(histogram(std::vector<std::int64_t>(9, 20 * ms), 3, 18),
              ElementsAre("   19.67 ms     0 ", "   20.00 ms     9 ", "   20.33 ms     0 "));
}

TEST(History, GivesTheRangesOfItsColumns) {
  History history;
  Values values;
  values.fill(NAN);
  for (std::int64_t n = 0; n < 500; ++n) {
    values[static_cast<std::size_t>(Value::pan)] = static_cast<double>(n);
    history.add(ms * (1000 + 20 * n), values);
  }
  EXPECT_EQ(history.newest(), ms * 10980);
  const auto columns = history.columns(Value::pan, 11'000 * ms, 10'000 * ms, 10);
  ASSERT_THAT(columns, SizeIs(10));
  EXPECT_EQ(columns[0].low, 0);
  EXPECT_EQ(columns[9].high, 499);
  for (std::size_t i = 1; i < 10; ++i) EXPECT_EQ(columns[i].low, columns[i - 1].high + 1);
  EXPECT_TRUE(history.columns(Value::lens, 11'000 * ms, 10'000 * ms, 10)[5].is_empty()) << "it is not known";
  const auto later = history.columns(Value::pan, 16'000 * ms, 10'000 * ms, 10);
  EXPECT_EQ(later[4].high, 499);
  EXPECT_TRUE(later[5].is_empty()) << "nothing was received since";
}

TEST(History, KeepsAMinuteAndIsClearedWhenTimeGoesBack) {
  History history;
  Values values{};
  for (std::int64_t n = 0; n < 70; ++n) history.add(n * 1000 * ms + ms, values);
  const auto columns = history.columns(Value::pan, 70'000 * ms, 70'000 * ms, 70);
  EXPECT_TRUE(columns[5].is_empty());
  EXPECT_FALSE(columns[20].is_empty());
  history.add(5 * ms, values);
  EXPECT_EQ(history.newest(), 5 * ms);
  EXPECT_TRUE(history.columns(Value::pan, 70'000 * ms, 70'000 * ms, 70)[20].is_empty());
}

}  // namespace trk_bridge::monitor::chart_test
