// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "file/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "url_errors.h"

namespace trk_bridge::file::file_settings_test {

using test::read_error;
using test::write_error;
using testing::AllOf;
using testing::HasSubstr;

SourceSettings file_in(const std::string& url) {
  const auto settings = source_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(SourceSettings{});
}
SinkSettings file_out(const std::string& url) {
  const auto settings = sink_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(SinkSettings{});
}

TEST(FileSettings, FilePaths) {
  EXPECT_EQ(file_in("file:take.trk").path, "take.trk");
  EXPECT_EQ(file_in("file:./a/take.trk").path, "./a/take.trk");
  EXPECT_EQ(file_in("file:/abs/take.trk").path, "/abs/take.trk");
  EXPECT_EQ(file_in("file:///abs/take.trk").path, "/abs/take.trk");
  EXPECT_EQ(file_in("file:what%3F%20100%25.trk?loop=1").path, "what? 100%.trk");
  EXPECT_EQ(file_in("file:a:b&c=d.trk").path, "a:b&c=d.trk");
  EXPECT_THAT(read_error("file:"), HasSubstr("no path"));
  EXPECT_THAT(read_error("file://host/take.trk"), HasSubstr("file:///PATH"));
  EXPECT_THAT(read_error("file:100%.trk"), HasSubstr("%25"));
  EXPECT_THAT(read_error("file:a%00b"), HasSubstr("%00"));
}

TEST(FileSettings, FileReadingOptions) {
  const auto defaults = file_in("file:a");
  EXPECT_FALSE(defaults.rate.has_value());
  EXPECT_EQ(defaults.speed, 1.0);
  EXPECT_FALSE(defaults.loop);
  EXPECT_EQ(defaults.time, FileTime::timecode);
  EXPECT_FALSE(defaults.lenient);
  const auto e = file_in("file:a?rate=59.94&speed=0&loop=1&time=now&date=2024-02-29&lenient=1");
  EXPECT_TRUE(e.lenient);
  EXPECT_EQ(e.rate, 59.94);
  EXPECT_EQ(e.speed, 0.0);
  EXPECT_TRUE(e.loop);
  EXPECT_EQ(e.time, FileTime::now);
  EXPECT_EQ(e.date, 1709164800) << "date -u -d 2024-02-29 +%s";
  EXPECT_EQ(file_in("file:a?date=1970-01-01").date, 0);
}

TEST(FileSettings, DatesThatTheCalendarDoesNotHave) {
  for (const char* date : {"2023-02-29", "2024-13-01", "2024-00-10", "2024-04-31", "24-04-30", "2024/04/30", "today"}) {
    EXPECT_THAT(read_error(std::string("file:a?date=") + date), AllOf(HasSubstr(date), HasSubstr("YYYY-MM-DD")));
  }
}

TEST(FileSettings, DatesEndWhereATakeCanStillBePlayed) {
  EXPECT_EQ(file_in("file:a?date=2249-12-31").date, 8'835'868'800) << "date -u -d 2249-12-31 +%s";
  for (const char* date : {"2250-01-01", "9999-12-31"}) {
    EXPECT_THAT(read_error(std::string("file:a?date=") + date),
                AllOf(HasSubstr(date), HasSubstr("1970-01-01 to 2249-12-31")));
  }
}

TEST(FileSettings, FileWritingOptions) {
  const auto e = file_out("file:a?timecode=10:20:30:12:2&overwrite=1");
  EXPECT_EQ(base::to_string(e.time_code.value()), "10:20:30:12:2");
  EXPECT_TRUE(e.overwrite);
  const auto defaults = file_out("file:a");
  EXPECT_FALSE(defaults.overwrite || defaults.number || defaults.time_code);
  EXPECT_EQ(defaults.rate, 50);
  const auto other = file_out("file:a?number=1&rate=59.94");
  EXPECT_TRUE(other.number);
  EXPECT_EQ(other.rate, 59.94);
  EXPECT_THAT(write_error("file:a?rate=201"), AllOf(HasSubstr("201"), HasSubstr("1 to 200")));
  EXPECT_THAT(write_error("file:a?number=1&overwrite=1"), HasSubstr("must not be given together with number=1"));
}

TEST(FileSettings, TheTimeInNamesOfRecordings) {
  constexpr std::int64_t time = 1'795'342'830'500'000'000;  // date -u -d 2026-11-22T10:20:30 +%s
  const auto name = [](const std::string& url) { return file_out(url).path.at(time); };
  EXPECT_EQ(name("file:takes/crane-%Y%m%d-%H%M%S.trk"), "takes/crane-20261122-102030.trk");
  EXPECT_EQ(name("file:%y%j.trk"), "26326.trk");
  EXPECT_EQ(name("file:what%3F%20100%25Y.trk"), "what? 100%Y.trk") << "a % that is written as %25 starts no escape";
  EXPECT_EQ(name("file:%d4-%D4-%41.trk"), "224-\xD4-A.trk") << "%d is the day, %D4 a byte";
  EXPECT_TRUE(file_out("file:%Y").path.has_time());
  EXPECT_FALSE(file_out("file:%25Y%41").path.has_time());
  EXPECT_EQ(file_out("file:%Y%25.trk").path.shown(), "%Y%.trk");
  for (const char* wrong : {"file:100%", "file:%00", "file:%Q", "file:%%", "file:%F"}) {
    EXPECT_THAT(write_error(wrong), AllOf(HasSubstr(wrong + 5), HasSubstr("Y y m d j H M S"), HasSubstr("%25")));
  }
  EXPECT_EQ(file_in("file:%d4").path, "\xD4") << "a file that is read already has a name";
  EXPECT_THAT(read_error("file:%Y"), HasSubstr("hexadecimal"));
}

}  // namespace trk_bridge::file::file_settings_test
