// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/transport/sink.h"

#include <cerrno>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "udp.h"

namespace trk_bridge::transport::sink_test {

using testing::HasSubstr;

/// Returns what the test sets, and counts the calls.
class Scripted final : public Sink {
 public:
  std::string name() const override { return "scripted"; }
  using Sink::count_constants;

  WriteResult answer;
  int puts = 0, finishes = 0;

 private:
  WriteResult put(const wire::CameraParams&) override {
    ++puts;
    return answer;
  }
  WriteResult put(const wire::CameraConstants&) override {
    ++puts;
    return answer;
  }
  WriteResult finish() override {
    ++finishes;
    return answer;
  }
};

WriteResult refused_by_system(int error) { return tl::make_unexpected(SinkFault{SinkReason::system, {}, error}); }

TEST(Sink, CountsSentAndFailedRecords) {
  Scripted sink;
  ASSERT_TRUE(sink.write(test::constants()));
  ASSERT_TRUE(sink.write(test::params(1)));
  ASSERT_TRUE(sink.write(test::params(2)));
  sink.answer = refused_by_system(ENETUNREACH);
  const auto written = sink.write(test::params(3));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error(), refused_by_system(ENETUNREACH).error());
  EXPECT_FALSE(sink.write(test::constants()));
  const auto statistics = sink.statistics();
  EXPECT_EQ(statistics.constants, 1u);
  EXPECT_EQ(statistics.params, 2u);
  EXPECT_EQ(statistics.errors, 2u);
}

TEST(Sink, KnowsTheTimeOfTheParametersThatItWrites) {
  class Timed final : public Sink {
   public:
    std::string name() const override { return "timed"; }
    std::int64_t written = -1;

   private:
    WriteResult put(const wire::CameraParams&) override {
      written = time().nanoseconds;
      return {};
    }
    WriteResult put(const wire::CameraConstants&) override { return {}; }
    WriteResult finish() override { return {}; }
  } sink;
  ASSERT_TRUE(sink.write(test::params(1), 1234));
  EXPECT_EQ(sink.written, 1234);
  ASSERT_TRUE(sink.write(test::params(2)));
  EXPECT_EQ(sink.written, 0) << "not known";
}

TEST(Sink, TheSameConstantsAgainAreWrittenAgain) {
  Scripted sink;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(sink.write(test::constants(720)));
  EXPECT_EQ(sink.puts, 3) << "the caller decides whether they are new";
  EXPECT_EQ(sink.statistics().constants, 3u);
}

TEST(Sink, RepeatedConstantsAreCountedWithTheNextWrite) {
  Scripted sink;
  sink.count_constants();
  ASSERT_TRUE(sink.write(test::params(1)));
  EXPECT_EQ(sink.statistics().constants, 1u);
}

TEST(Sink, AClosedSinkReportsItAndIsNotCalledAgain) {
  Scripted sink;
  ASSERT_TRUE(sink.close());
  EXPECT_EQ(sink.finishes, 1);
  EXPECT_EQ(sink.write(test::params(1)).error().reason, SinkReason::closed);
  EXPECT_EQ(sink.write(test::constants()).error().reason, SinkReason::closed);
  EXPECT_EQ(sink.puts, 0);
  EXPECT_EQ(sink.statistics().errors, 2u);
  ASSERT_TRUE(sink.close()) << "closing again does nothing";
  EXPECT_EQ(sink.finishes, 1);
}

TEST(Sink, ACloseThatFailsIsAnErrorOnce) {
  Scripted sink;
  sink.answer = refused_by_system(ENOSPC);
  const auto closed = sink.close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().error_number, ENOSPC);
  EXPECT_EQ(sink.statistics().errors, 1u);
  EXPECT_TRUE(sink.close());
  EXPECT_EQ(sink.statistics().errors, 1u);
  EXPECT_EQ(sink.write(test::params(1)).error().reason, SinkReason::closed) << "it is closed nevertheless";
}

TEST(SinkFault, EveryReasonHasItsOwnText) {
  std::set<std::string> texts;
  SinkFault system{SinkReason::system};
  system.error_number = ENETUNREACH;
  EXPECT_THAT(describe(system), HasSubstr("unreachable"));
  const auto reasons = {SinkReason::not_encodable, SinkReason::no_constants, SinkReason::constants_changed,
                        SinkReason::other_camera,  SinkReason::system,       SinkReason::no_interface,
                        SinkReason::no_segment,    SinkReason::closed};
  for (const SinkReason reason : reasons) texts.insert(describe(SinkFault{reason}));
  EXPECT_EQ(texts.size(), reasons.size());
}

TEST(SinkFault, IsCountedByReasonFaultAndErrorNumber) {
  const SinkFault encode{SinkReason::not_encodable, wire::Fault{wire::Reason::not_finite, 5, true}};
  const SinkFault other_field{SinkReason::not_encodable, wire::Fault{wire::Reason::not_finite, 6, true}};
  const SinkFault unreachable{SinkReason::system, {}, ENETUNREACH}, refused{SinkReason::system, {}, EACCES};
  EXPECT_EQ(std::set<SinkFault>({encode, other_field, unreachable, refused, encode, refused}).size(), 4u);
  EXPECT_EQ(describe(encode), "the record cannot be written: field 5 is not finite");
}

}  // namespace trk_bridge::transport::sink_test
