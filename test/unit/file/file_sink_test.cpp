// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Recordings by URL.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "deadline.h"
#include "error_of.h"
#include "file/recording_name.h"
#include "temporary_directory.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"
#include "whole_take.h"

namespace trk_bridge::file::file_sink_test {

using namespace std::chrono_literals;
using endpoints::open_sink;
using std::filesystem::exists;
using test::constants;
using test::params;
using test::read_text;
using test::write_text;
using testing::ElementsAre;
using testing::HasSubstr;
using transport::Sink;
using transport::SinkReason;
using transport::TransportError;

// date -u -d 2026-11-22T10:20:30.5 +%s.%N
constexpr std::int64_t moment = 1'795'342'830'500'000'000;
constexpr std::int64_t second = 1'000'000'000;

class FileSinkTest : public testing::Test {
 protected:
  std::string url(const std::string& rest) const { return "file:" + directory.path() + "/" + rest; }
  std::string opening_error(const std::string& rest) const {
    return test::error_of<TransportError>([&] { static_cast<void>(open_sink(url(rest))); });
  }
  std::unique_ptr<Sink> unopened(const std::string& rest) const { return endpoints::parse_sink(url(rest))->open(); }
  /// A recording that starts at that time.
  void record(const std::string& rest, std::int64_t time = moment) const {
    const auto sink = open_sink(url(rest));
    ASSERT_TRUE(sink->write(constants()));
    ASSERT_TRUE(sink->write(params(1), time));
    ASSERT_TRUE(sink->write(params(2), time + second));
    ASSERT_TRUE(sink->close());
  }
  std::string code_in(const std::string& name) const { return base::to_string(read_take(directory / name).time_code); }
  /// As after a writer was killed.
  void leave_part(const std::string& name) const {
    write_text(directory / (name + ".part"),
               "DMC01\n10:20:30:12:1\n720 576 0 0 0 0 8.8 6.6 8.8 6.6\n1 2 3 4 5 6 7\n1 2");
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  test::TemporaryDirectory directory;
};

TEST_F(FileSinkTest, TheTimeCodeIsTheTimeOfDayOfTheFirstField) {
  record("a.trk");
  EXPECT_EQ(code_in("a.trk"), "10:20:30:12:2") << "25 fields after the second";
  record("b.trk?rate=60");
  EXPECT_EQ(code_in("b.trk"), "10:20:30:15:1");
  record("c.trk?timecode=01:02:03:04:1");
  EXPECT_EQ(code_in("c.trk"), "01:02:03:04:1");
}

TEST_F(FileSinkTest, WithoutATimeItIsTheCurrentTime) {
  // At a time at which the minute does not end during the test.
  const auto minutes = [] { return std::time(nullptr) / 60; };
  std::time_t before = 0;
  std::string code;
  for (int i = 0; i == 0 || before != minutes(); ++i) {
    before = minutes();
    record("now" + std::to_string(i) + ".trk", 0);
    code = code_in("now" + std::to_string(i) + ".trk");
  }
  char expected[8];
  const std::time_t begin = before * 60;
  std::strftime(expected, sizeof expected, "%H:%M:", std::gmtime(&begin));
  EXPECT_THAT(code, testing::StartsWith(expected));
}

TEST_F(FileSinkTest, ATakeWithoutFieldsHasItsConstants) {
  const auto sink = open_sink(url("a.trk"));
  ASSERT_TRUE(sink->write(constants(1920)));
  ASSERT_TRUE(sink->close());
  EXPECT_EQ(read_take(directory / "a.trk").constants, constants(1920));
}

TEST_F(FileSinkTest, TheNameIsThatOfTheTimeOfTheFirstField) {
  const auto sink = open_sink(url("crane-%Y%m%d-%H%M%S.trk"));
  ASSERT_TRUE(sink->write(constants()));
  EXPECT_THAT(files(), ElementsAre()) << "which is not known yet";
  EXPECT_THAT(sink->name(), HasSubstr("crane-%Y%m%d-%H%M%S.trk"));
  ASSERT_TRUE(sink->write(params(1), moment));
  EXPECT_THAT(sink->name(), HasSubstr("crane-20261122-102030.trk"));
  EXPECT_THAT(files(), ElementsAre("crane-20261122-102030.trk.part"));
  ASSERT_TRUE(sink->write(params(2), moment + 5 * second));
  ASSERT_TRUE(sink->close());
  EXPECT_THAT(files(), ElementsAre("crane-20261122-102030.trk"));
  EXPECT_EQ(code_in("crane-20261122-102030.trk"), "10:20:30:12:2");
}

TEST_F(FileSinkTest, AMissingFolderIsReportedAtOnceForNamesWithTimes) {
  EXPECT_THAT(opening_error("absent/%Y.trk"),
              AllOf(HasSubstr("absent/%Y.trk"), HasSubstr("No such file or directory")));
  EXPECT_EQ(opening_error("%Y.trk"), "no error");
}

TEST_F(FileSinkTest, NumbersFollowTheHighest) {
  write_text(directory / "crane-007.trk", "precious");
  write_text(directory / "crane-003.trk", "precious");
  write_text(directory / "crane-0123close.trk", "another name");
  for (int i = 0; i < 3; ++i) record("crane.trk?number=1");
  EXPECT_THAT(files(), ElementsAre("crane-003.trk", "crane-007.trk", "crane-008.trk", "crane-009.trk", "crane-010.trk",
                                   "crane-0123close.trk"));
  EXPECT_EQ(read_text(directory / "crane-007.trk"), "precious");
  record("crane-%Y.trk?number=1");
  EXPECT_TRUE(exists(directory / "crane-2026-001.trk"));
  record("no_ending?number=1");
  EXPECT_TRUE(exists(directory / "no_ending-001"));
  for (int i = 0; i < 2; ++i) record("[a]*%3F.trk?number=1");
  EXPECT_TRUE(exists(directory / "[a]*?-002.trk"));
}

TEST_F(FileSinkTest, TheNumberOfARecoveredRecordingIsNotUsedAgain) {
  leave_part("crane-004.trk");
  record("crane.trk?number=1");
  EXPECT_THAT(files(), ElementsAre("crane-004.recovered.trk", "crane-005.trk"));
}

TEST_F(FileSinkTest, TwoWritersAtTheSameTimeNeverGetOneNumber) {
  constexpr int writers = 4, each = 25;
  std::vector<std::thread> threads;
  for (int i = 0; i < writers; ++i) {
    threads.emplace_back([this] {
      for (int n = 0; n < each; ++n) record("crane.trk?number=1");
    });
  }
  for (auto& thread : threads) thread.join();
  const auto all = files();
  EXPECT_EQ(all.size(), static_cast<std::size_t>(writers * each));
  for (const auto& name : all) EXPECT_EQ(read_take(directory / name).params.size(), 2u) << name;
}

TEST_F(FileSinkTest, NumbersAreLimited) {
  write_text(directory / "crane-9998.trk", "");
  record("crane.trk?number=1");
  EXPECT_TRUE(exists(directory / "crane-9999.trk"));
  EXPECT_THAT(opening_error("crane.trk?number=1"), HasSubstr("all numbers from 001 to 9999 are in use"));
}

TEST_F(FileSinkTest, AnInterruptedRecordingIsRecoveredAndReported) {
  leave_part("crane.trk");
  const auto sink = open_sink(url("crane.trk"));
  EXPECT_THAT(sink->notice(), AllOf(HasSubstr("recovered"), HasSubstr("crane.recovered.trk")));
  EXPECT_THAT(files(), ElementsAre("crane.recovered.trk", "crane.trk.part"));
  EXPECT_THAT(read_text(directory / "crane.recovered.trk"), testing::EndsWith("\n1 2 3 4 5 6 7\n"));
}

TEST_F(FileSinkTest, InterruptedRecordingsWithOlderNamesAreRecovered) {
  leave_part("crane-20201122-102030.trk");
  leave_part("other-20201122-102030.trk");
  leave_part("crane-2020112-102030.trk");
  const auto sink = open_sink(url("crane-%Y%m%d-%H%M%S.trk"));
  EXPECT_THAT(sink->notice(), HasSubstr("crane-20201122-102030.recovered.trk"));
  EXPECT_THAT(files(), ElementsAre("crane-2020112-102030.trk.part", "crane-20201122-102030.recovered.trk",
                                   "other-20201122-102030.trk.part"));
}

TEST_F(FileSinkTest, WhatIsBeingWrittenIsNotRecovered) {
  const auto one = open_sink(url("crane-%Y%m%d-%H%M%S.trk"));
  ASSERT_TRUE(one->write(constants()) && one->write(params(1), moment));
  const auto other = open_sink(url("crane-%Y%m%d-%H%M%S.trk"));
  EXPECT_EQ(other->notice(), "");
  ASSERT_TRUE(one->write(params(2), moment) && one->close());
  EXPECT_EQ(read_take(directory / "crane-20261122-102030.trk").params.size(), 2u);
}

TEST_F(FileSinkTest, WhyANameCannotBeOpened) {
  write_text(directory / "there.trk", "precious");
  EXPECT_THAT(opening_error("there.trk"), HasSubstr("there.trk: cannot be written: it exists; to overwrite it, use"));
  EXPECT_THAT(opening_error(""), HasSubstr("it is neither an ordinary file nor a FIFO"));
  EXPECT_THAT(opening_error("absent/a.trk"), HasSubstr("No such file or directory"));
  const auto sink = open_sink(url("mine.trk"));
  EXPECT_THAT(opening_error("mine.trk"), HasSubstr("another writer is writing it"));
}

TEST_F(FileSinkTest, AFileThatCannotBeOpenedIsOpenedByALaterWrite) {
  write_text(directory / "there.trk", "precious");
  const auto sink = unopened("there.trk");
  ASSERT_TRUE(sink->write(constants()));
  EXPECT_EQ(sink->write(params(1), moment).error().reason, SinkReason::exists);
  std::filesystem::remove(directory / "there.trk");
  std::uint64_t counter = 1;
  EXPECT_TRUE(test::becomes_true([&] { return sink->write(params(++counter), moment + second).has_value(); }));
  ASSERT_TRUE(sink->close());
  const auto take = read_take(directory / "there.trk");
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0].counter, counter);
  EXPECT_EQ(base::to_string(take.time_code), "10:20:31:12:2") << "of the first field in it";
}

TEST_F(FileSinkTest, AFileThatWasNeverOpenedEndsWithTheReason) {
  write_text(directory / "there.trk", "precious");
  const auto sink = unopened("there.trk");
  ASSERT_TRUE(sink->write(constants()));
  EXPECT_FALSE(sink->write(params(1)));
  const auto closed = sink->close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().reason, SinkReason::exists);
  EXPECT_EQ(read_text(directory / "there.trk"), "precious");
}

TEST_F(FileSinkTest, AFifoWaitsForItsReader) {
  ASSERT_EQ(::mkfifo((directory / "fifo").c_str(), 0600), 0);
  const auto sink = open_sink(url("fifo"));
  EXPECT_THAT(sink->notice(), HasSubstr("no program reads this FIFO"));
  ASSERT_TRUE(sink->write(constants()));
  EXPECT_EQ(sink->write(params(1)).error().reason, SinkReason::no_reader);
  const transport::Descriptor reader(::open((directory / "fifo").c_str(), O_RDONLY | O_NONBLOCK));
  int missed = 0;
  while (!sink->write(params(2)) && missed < 1000) {
    ++missed;
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_LT(missed, 50) << "a reader misses less than half a second";
  EXPECT_EQ(sink->notice(), "");
  char begin[6] = {};
  EXPECT_EQ(::read(reader.get(), begin, 5), 5);
  EXPECT_STREQ(begin, "DMC01");
  EXPECT_TRUE(sink->close());
  EXPECT_THAT(files(), ElementsAre("fifo"));
}

}  // namespace trk_bridge::file::file_sink_test
