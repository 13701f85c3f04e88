#include "trk_bridge/base/time_code.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::base {
namespace {

constexpr std::int64_t second = 1'000'000'000;

TEST(TimeCode, IsReadAndWritten) {
  const auto code = parse_time_code("10:20:30:12:2");
  ASSERT_TRUE(code) << code.error();
  EXPECT_EQ(code->hours, 10);
  EXPECT_EQ(code->minutes, 20);
  EXPECT_EQ(code->seconds, 30);
  EXPECT_EQ(code->frames, 12);
  EXPECT_EQ(code->field, 2);
  EXPECT_EQ(to_string(*code), "10:20:30:12:2");
  EXPECT_EQ(to_string(parse_time_code("1:2:3:4:1").value()), "01:02:03:04:1");
}

TEST(TimeCode, EveryWrongTextIsNamed) {
  for (const std::string text : {"", "10:20:30:12", "10:20:30:12:3", "10:20:30:12:0", "24:00:00:00:1", "00:60:00:00:1",
                                 "00:00:60:00:1", "00:00:00:100:1", "-1:00:00:00:1", "10:20:30:12:1:1", "10;20;30;12;1",
                                 "a0:00:00:00:1", "10:20:30: 2:1", "10:20::12:1"}) {
    const auto code = parse_time_code(text);
    ASSERT_FALSE(code) << text;
    EXPECT_THAT(code.error(), testing::HasSubstr("\"" + text + "\""));
    EXPECT_THAT(code.error(), testing::HasSubstr("HH:MM:SS:FF:D"));
  }
}

TEST(TimeCode, FieldsOfPalAreTwentyMilliseconds) {
  const TimeCode code{10, 20, 30, 24, 2};
  EXPECT_EQ(nanoseconds_of(code, 50.0, 0), (10 * 3600 + 20 * 60 + 30) * second + 980'000'000LL);
  EXPECT_EQ(nanoseconds_of(code, 50.0, 1), (10 * 3600 + 20 * 60 + 31) * second);
}

TEST(TimeCode, NonDropNtscRunsLateByItsRate) {
  // One nominal hour of 60 fields a second lasts 3603.6 s at 60000/1001 Hz.
  EXPECT_EQ(nanoseconds_of({1, 0, 0, 0, 1}, 60000.0 / 1001.0, 0), 3'603'600'000'000LL);
}

TEST(TimeCode, GoesOnPastMidnight) {
  EXPECT_EQ(nanoseconds_of({23, 59, 59, 24, 2}, 50.0, 1), 24 * 3600 * second);
  EXPECT_EQ(nanoseconds_of({0, 0, 0, 0, 1}, 50.0, 50ULL * 86400 * 400), 400LL * 86400 * second);
}

TEST(TimeCode, AFrameThatTheRateDoesNotHaveIsRefused) {
  EXPECT_TRUE(nanoseconds_of({0, 0, 0, 24, 2}, 50.0, 0));
  const auto wrong = nanoseconds_of({0, 0, 0, 25, 1}, 50.0, 0);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error(), testing::HasSubstr("00:00:00:25:1"));
  EXPECT_TRUE(nanoseconds_of({0, 0, 0, 29, 2}, 59.94, 0));
}

}  // namespace
}  // namespace trk_bridge::base
