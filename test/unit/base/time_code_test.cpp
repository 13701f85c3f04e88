// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/base/time_code.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::base::time_code_test {

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
  EXPECT_FALSE(code->drop_frame);
  EXPECT_TRUE(parse_time_code("10:20:30;12:2").value().drop_frame);
  EXPECT_EQ(to_string(parse_time_code("10:20:30;12:2").value()), "10:20:30;12:2");
  EXPECT_EQ(to_string(parse_time_code("1:2:3:4:1").value()), "01:02:03:04:1");
}

TEST(TimeCode, EveryWrongTextIsNamed) {
  for (const std::string text : {"", "10:20:30:12", "10:20:30:12:3", "10:20:30:12:0", "24:00:00:00:1", "00:60:00:00:1",
                                 "00:00:60:00:1", "00:00:00:100:1", "-1:00:00:00:1", "10:20:30:12:1:1", "10;20;30;12;1",
                                 "10:20:30:12;1", "a0:00:00:00:1", "10:20:30: 2:1", "10:20::12:1"}) {
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

TEST(TimeCode, ContinuesPastMidnight) {
  EXPECT_EQ(nanoseconds_of({23, 59, 59, 24, 2}, 50.0, 1), 24 * 3600 * second);
  EXPECT_EQ(nanoseconds_of({0, 0, 0, 0, 1}, 50.0, 50ULL * 86400 * 400), 400LL * 86400 * second);
}

TEST(TimeCode, AFrameThatTheRateDoesNotHaveIsRefused) {
  EXPECT_TRUE(nanoseconds_of({0, 0, 0, 24, 2}, 50.0, 0));
  const auto wrong = nanoseconds_of({0, 0, 0, 25, 1}, 50.0, 0);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error(), testing::HasSubstr("00:00:00:25:1"));
  EXPECT_TRUE(nanoseconds_of({0, 0, 0, 29, 2}, 59.94, 0));
  // Up to 30 Hz a sample is a frame's; it may be taken with the second field.
  EXPECT_EQ(nanoseconds_of({0, 0, 0, 24, 2}, 25.0, 0), 980'000'000);
  EXPECT_EQ(to_string(time_code_after({0, 0, 0, 24, 2}, 25.0, 1).value()), "00:00:01:00:2");
  EXPECT_FALSE(nanoseconds_of({0, 0, 0, 25, 1}, 25.0, 0));
}

struct Counted {
  double rate;
  std::uint64_t index;
  const char* code;
};

// After 00:00:00 of that kind.
void expect_counted(const std::vector<Counted>& table) {
  for (const auto& [rate, index, text] : table) {
    const auto code = parse_time_code(text).value();
    const TimeCode first{0, 0, 0, 0, 1, code.drop_frame};
    EXPECT_EQ(to_string(time_code_after(first, rate, index).value()), text) << rate;
    EXPECT_EQ(nanoseconds_of(code, rate, 0), nanoseconds_of(first, rate, index)) << text;
    EXPECT_EQ(to_string(time_code_at(nanoseconds_of(first, rate, index).value(), rate, code.drop_frame).value()), text);
  }
}

TEST(TimeCode, DropFrameSkipsTwoFramesAMinuteExceptEveryTenth) {
  // SMPTE ST 12-1: 17982 frames in ten minutes, 107892 in an hour, 2589408 in a day.
  expect_counted({{29.97, 1799, "00:00:59;29:1"},
                  {29.97, 1800, "00:01:00;02:1"},
                  {29.97, 3597, "00:01:59;29:1"},
                  {29.97, 3598, "00:02:00;02:1"},
                  {29.97, 17981, "00:09:59;29:1"},
                  {29.97, 17982, "00:10:00;00:1"},
                  {29.97, 19782, "00:11:00;02:1"},
                  {29.97, 107892, "01:00:00;00:1"},
                  {29.97, 2589407, "23:59:59;29:1"},
                  {29.97, 2589408 - 1 - 107892, "22:59:59;29:1"}});
  // Two fields a frame.
  expect_counted({{59.94, 3599, "00:00:59;29:2"},
                  {59.94, 3600, "00:01:00;02:1"},
                  {59.94, 35963, "00:09:59;29:2"},
                  {59.94, 35964, "00:10:00;00:1"},
                  {59.94, 215784, "01:00:00;00:1"}});
  // 60 frames a second: four.
  expect_counted({{119.88, 7199, "00:00:59;59:2"}, {119.88, 7200, "00:01:00;04:1"}, {119.88, 431568, "01:00:00;00:1"}});
  EXPECT_EQ(to_string(time_code_after({23, 59, 59, 29, 1, true}, 29.97, 1).value()), "00:00:00;00:1");
}

TEST(TimeCode, DropFrameFollowsTheClock) {
  // An hour of 107892 frames of 1001/30000 s is 3.6 ms short of an hour.
  EXPECT_EQ(nanoseconds_of({1, 0, 0, 0, 1, true}, 29.97, 0), 3'599'996'400'000LL);
}

TEST(TimeCode, NonDropFilmRatesCountWholeFrames) {
  expect_counted({{23.976, 23, "00:00:00:23:1"},
                  {23.976, 24, "00:00:01:00:1"},
                  {23.976, 86400, "01:00:00:00:1"},
                  {47.952, 47, "00:00:00:23:2"},
                  {59.94, 3600, "00:01:00:00:1"},
                  {59.94, 216000, "01:00:00:00:1"}});
  EXPECT_EQ(nanoseconds_of({1, 0, 0, 0, 1}, 23.976, 0), 3'603'600'000'000LL);
  EXPECT_EQ(exact_rate(59.94), 60000.0 / 1001.0);
  EXPECT_EQ(exact_rate(60), 60);
  EXPECT_EQ(exact_rate(59.9), 59.9);
}

TEST(TimeCode, CodesThatDropFrameSkipsAreRefused) {
  for (const TimeCode& code : {TimeCode{0, 1, 0, 0, 1, true}, TimeCode{10, 59, 0, 1, 1, true}}) {
    EXPECT_THAT(nanoseconds_of(code, 29.97, 0).error(), testing::HasSubstr(to_string(code)));
  }
  EXPECT_TRUE(nanoseconds_of({0, 10, 0, 0, 1, true}, 29.97, 0));
  EXPECT_TRUE(nanoseconds_of({0, 1, 1, 0, 1, true}, 29.97, 0));
  for (const double rate : {50.0, 23.976, 30.0, 60.0, 47.952}) {
    EXPECT_THAT(time_code_after({0, 0, 0, 0, 1, true}, rate, 0).error(), testing::HasSubstr("29.97, 59.94 and 119.88"));
    EXPECT_FALSE(time_code_at(0, rate, true));
  }
}

}  // namespace trk_bridge::base::time_code_test
