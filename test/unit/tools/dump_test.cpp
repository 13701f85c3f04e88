// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tools/dump.h"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "memory_feed.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"

namespace trk_bridge::tools::dump_test {

using testing::HasSubstr;

int lines(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

class DumpTest : public testing::Test {
 protected:
  cli::ExitCode run(const DumpOptions& options = {}) { return dump(*feed.source(), options, out, err); }

  test::MemoryFeed feed;
  std::ostringstream out, err;
};

TEST_F(DumpTest, OneLinePerRecordAndTheSummaryByCameraAndSender) {
  feed.put(test::constants(720, 7));
  for (const std::uint64_t counter : {1u, 2u, 5u, 4u, 5u, 6u}) feed.put(test::params(counter, 7));
  feed.put(test::params(100, 8));
  feed.put(test::params(100, 8), 6000);
  feed.put(transport::Event::ended);
  EXPECT_EQ(run(), cli::exit_good);
  EXPECT_EQ(lines(out.str()), 9);
  EXPECT_THAT(err.str(), HasSubstr("received 9 (8 parameters, 1 constants), malformed 0"));
  EXPECT_THAT(err.str(), HasSubstr("id 7 from 127.0.0.1:5000: "));
  EXPECT_THAT(err.str(), HasSubstr(", 1 lost, 1 duplicate, 1 out of order, 0 restarts"));
  EXPECT_THAT(err.str(), HasSubstr("id 8 from 127.0.0.1:5000: 1 accepted, 0 lost"));
  EXPECT_THAT(err.str(), HasSubstr("id 8 from 127.0.0.1:6000: 1 accepted, 0 lost"));
}

TEST_F(DumpTest, NothingReceivedBeforeALimitHasItsExitCode) {
  DumpOptions limited;
  limited.seconds = 0.01;
  EXPECT_EQ(run(limited), cli::exit_nothing);
  EXPECT_THAT(err.str(), HasSubstr("received 0 "));
  limited = {};
  limited.count = 1;
  feed.put_malformed(wire::Reason::bad_magic);
  feed.put(transport::Event::ended);
  EXPECT_EQ(run(limited), cli::exit_nothing) << "a malformed record is not received";
  feed.put(transport::Event::ended);
  EXPECT_EQ(run(), cli::exit_good) << "without a limit, a source that ends at once is no error";
}

TEST_F(DumpTest, NewRecordsWhoseCounterDoesNotCountAreAccepted) {
  for (int n = 0; n < 100; ++n) {
    auto params = test::params(static_cast<std::uint64_t>(n % 25), 7);
    params.euler.pan = n;
    feed.put(params);
  }
  feed.put(transport::Event::ended);
  EXPECT_EQ(run(), cli::exit_good);
  EXPECT_THAT(err.str(), HasSubstr("100 accepted, 0 lost, 0 duplicate, 0 out of order"));
}

TEST_F(DumpTest, MalformedInputIsALineOnStandardErrorOnly) {
  feed.put_malformed(wire::Reason::bad_magic);
  feed.put(test::params(1));
  feed.put(transport::Event::ended);
  EXPECT_EQ(run(), cli::exit_good);
  EXPECT_EQ(lines(out.str()), 1);
  EXPECT_THAT(err.str(), HasSubstr("trk: malformed record from 127.0.0.1:5000: bad magic"));
  EXPECT_THAT(err.str(), HasSubstr("malformed 1"));
}

TEST_F(DumpTest, CountsOnlyPrintedRecords) {
  feed.put_malformed(wire::Reason::truncated);
  for (std::uint64_t counter = 1; counter <= 5; ++counter) feed.put(test::params(counter));
  DumpOptions options;
  options.count = 3;
  EXPECT_EQ(run(options), cli::exit_good);
  EXPECT_EQ(lines(out.str()), 3);
}

TEST_F(DumpTest, EndsAfterItsTimeAlthoughNothingArrives) {
  DumpOptions options;
  options.seconds = 0.05;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run(options), cli::exit_nothing);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(50));
  EXPECT_THAT(err.str(), HasSubstr("received 0"));
}

TEST_F(DumpTest, ReportsWhatItWaitedForAtTheEnd) {
  DumpOptions options;
  options.seconds = 0.01;
  (void)dump(*endpoints::open_source("udp://239.255.77.1:0?interface=nosuch0"), options, out, err);
  EXPECT_THAT(err.str(), HasSubstr(": no interface has the address or name nosuch0; there are "));
}

TEST_F(DumpTest, AFailedSourceIsAFailure) {
  feed.put(transport::Event::failed);
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_THAT(err.str(), HasSubstr("trk: error: memory"));
}

TEST_F(DumpTest, AnOutputErrorEndsIt) {
  feed.put(test::params(1));
  feed.put(test::params(2));
  out.setstate(std::ios::badbit);
  EXPECT_EQ(run(), cli::exit_failed);
  EXPECT_THAT(err.str(), HasSubstr("trk: error: standard output"));
  EXPECT_THAT(err.str(), HasSubstr("received 1 "));
}

}  // namespace trk_bridge::tools::dump_test
