#include "file/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "url_errors.h"

namespace trk_bridge::file {
namespace {

using test::read_error;
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
  EXPECT_EQ(base::to_string(e.time_code), "10:20:30:12:2");
  EXPECT_TRUE(e.overwrite);
  EXPECT_FALSE(file_out("file:a").overwrite);
}

}  // namespace
}  // namespace trk_bridge::file
