// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/base/time_code.h"

#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::base::time_code_at_test {

using testing::HasSubstr;

constexpr std::int64_t second = 1'000'000'000;

std::string code_at(std::int64_t nanoseconds, double rate) {
  const auto code = time_code_at(nanoseconds, rate);
  return code ? to_string(*code) : code.error();
}

TEST(TimeCodeAt, CountsFieldsSinceMidnight) {
  EXPECT_EQ(code_at(0, 50), "00:00:00:00:1");
  EXPECT_EQ(code_at(20'000'000, 50), "00:00:00:00:2");
  EXPECT_EQ(code_at(40'000'000, 50), "00:00:00:01:1");
  // 10:20:30 is 37230 s.
  EXPECT_EQ(code_at(37230 * second + 480'000'000, 50), "10:20:30:12:1");
  EXPECT_EQ(code_at(37230 * second + 980'000'000, 50), "10:20:30:24:2");
}

TEST(TimeCodeAt, RoundsToTheNearestField) {
  EXPECT_EQ(code_at(29'999'999, 50), "00:00:00:00:2");
  EXPECT_EQ(code_at(30'000'001, 50), "00:00:00:01:1");
}

TEST(TimeCodeAt, NominalSecondsAreLongerThanSecondsBelowTheNominalRate) {
  // 60 nominal fields take 1.001 s at 60000/1001 Hz.
  EXPECT_EQ(code_at(1'001'000'000, 60000.0 / 1001.0), "00:00:01:00:1");
  EXPECT_EQ(code_at(3600 * 1'001'000'000LL, 60000.0 / 1001.0), "01:00:00:00:1");
}

TEST(TimeCodeAt, StartsAgainAtMidnight) {
  EXPECT_EQ(code_at(86399 * second + 980'000'000, 50), "23:59:59:24:2");
  EXPECT_EQ(code_at(86400 * second, 50), "00:00:00:00:1");
}

TEST(TimeCodeAt, IsTheInverseOfNanosecondsOf) {
  for (const double rate : {1.0, 23.976, 25.0, 29.97, 50.0, 59.94, 60000.0 / 1001.0, 60.0, 119.88, 200.0}) {
    for (const char* text : {"00:00:00:00:1", "03:13:51:00:1", "10:20:30:12:1", "23:59:59:00:1"}) {
      const auto code = parse_time_code(text).value();
      const auto time = nanoseconds_of(code, rate, 0);
      if (!time) continue;
      EXPECT_EQ(code_at(*time, rate), text) << rate;
    }
  }
}

TEST(TimeCodeAt, RefusesTimesWithoutCode) {
  EXPECT_THAT(code_at(-1, 50), HasSubstr("before midnight"));
  EXPECT_THAT(code_at(0, 0), HasSubstr("rates are"));
  EXPECT_THAT(code_at(990'000'000, 240), HasSubstr("frame 119"));
  EXPECT_EQ(code_at(500'000'000, 240), "00:00:00:60:1");
}

}  // namespace trk_bridge::base::time_code_at_test
