// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "base/time_text.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::base::time_text_test {

using testing::AllOf;
using testing::HasSubstr;

TEST(TimeText, IsExactOnBothSidesOf1970) {
  EXPECT_EQ(seconds_text(0), "0.000000000");
  EXPECT_EQ(seconds_text(-1), "-0.000000001");
  EXPECT_EQ(seconds_text(-1'500'000'000), "-1.500000000");
  EXPECT_EQ(seconds_text(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
  EXPECT_EQ(iso_time(0), "1970-01-01T00:00:00.000000000Z");
  EXPECT_EQ(iso_time(-1), "1969-12-31T23:59:59.999999999Z");
}

TEST(Days, EndWhereRosDoes) {
  EXPECT_EQ(parse_date("2106-02-06"), 4'294'857'600'000'000'000);
  for (const char* day : {"2106-02-07", "2106-02-08"}) {
    const auto date = parse_date(day);
    ASSERT_FALSE(date) << day;
    EXPECT_THAT(date.error(), AllOf(HasSubstr(day), HasSubstr("to 2106-02-06")));
  }
  EXPECT_THAT(parse_date("2023-02-29").error(), AllOf(HasSubstr("\"2023-02-29\""), HasSubstr("YYYY-MM-DD")));
  EXPECT_EQ(day_from_text("2024-02-29"), 1709164800) << "date -u -d 2024-02-29 +%s";
  EXPECT_TRUE(day_from_text("9999-12-31")) << "the calendar continues beyond the range of ROS";
}

TEST(Moments, AreReadToTheNanosecond) {
  EXPECT_EQ(parse_date("1970-01-02"), 86'400'000'000'000);
  EXPECT_EQ(parse_date("2026-11-22"), 1'795'305'600'000'000'000);
  EXPECT_EQ(parse_moment("1700000000.123456789"), 1'700'000'000'123'456'789);
  EXPECT_EQ(parse_moment("5"), 5'000'000'000);
  EXPECT_EQ(parse_moment("2026-11-22T10:20:30.5Z"), 1'795'305'600'000'000'000 + 37'230'500'000'000);
  EXPECT_EQ(parse_moment("2026-11-22T10:20:30"), 1'795'305'600'000'000'000 + 37'230'000'000'000);
}

TEST(Moments, EndWhereRosDoes) {
  constexpr std::int64_t last = 4'294'967'295'999'999'999;
  EXPECT_EQ(parse_moment("2106-02-07T06:28:15.999999999"), last);
  EXPECT_EQ(parse_moment("4294967295.999999999"), last);
  for (const char* text : {"2106-02-07T06:28:16", "2106-02-08T00:00:00", "9999-12-31T00:00:00", "4294967296"}) {
    const auto moment = parse_moment(text);
    ASSERT_FALSE(moment) << text;
    EXPECT_THAT(moment.error(), AllOf(HasSubstr(text), HasSubstr("up to 2106-02-07T06:28:15")));
  }
}

TEST(Moments, InvalidOnesAreRefused) {
  for (const char* text :
       {"", "0", "-1", "1.", ".5", "1.0000000001", "1e9", "4294967296", "2026-11-22T", "2026-11-22T24:00:00",
        "2026-11-22T10:60:00", "2026-11-22T10:20", "2026-02-30T10:20:30", "tomorrow", "12 "}) {
    EXPECT_FALSE(parse_moment(text)) << text;
  }
  for (const char* text : {"", "2026", "2026-13-01", "2026-02-30", "1969-12-31", "2026-11-22&rate=50", "2026-11-22 "}) {
    EXPECT_FALSE(parse_date(text)) << text;
  }
}

TEST(TimeText, RoundTrips) {
  const std::int64_t moment = 1'700'000'000'123'456'789;
  EXPECT_EQ(parse_moment(iso_time(moment)), moment);
  EXPECT_EQ(parse_moment(seconds_text(moment)), moment);
}

}  // namespace trk_bridge::base::time_text_test
