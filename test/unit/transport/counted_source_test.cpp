// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "transport/counted_source.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "memory_feed.h"
#include "udp.h"

namespace trk_bridge::transport::counted_source_test {

using testing::HasSubstr;

/// A source with the counts that the test sets.
class Scripted final : public CountedSource {
 public:
  Scripted() : CountedSource("scripted") {}

  using CountedSource::ended;
  using CountedSource::failed;
  using CountedSource::final_event;
  using CountedSource::malformed;
  using CountedSource::refused;
  using CountedSource::sample;

  Event receive(Reception&, std::chrono::nanoseconds) override { return final_event(); }

 private:
  void complete(SourceStatistics& statistics) const override {
    statistics.overwritten = 5;
    if (statistics.state == SourceState::waiting) statistics.waiting_for = "the test";
  }
};

Sample sample_of(const wire::Record& record) {
  Sample sample;
  sample.record = record;
  return sample;
}

SourceState state_of(const Source& source) { return source.statistics().state; }

TEST(CountedSource, OnlyAValidRecordLeadsToReceiving) {
  Scripted source;
  EXPECT_EQ(state_of(source), SourceState::waiting);
  EXPECT_EQ(source.statistics().waiting_for, "the test");

  Sender sender;
  sender.kind = SenderKind::ipv4;
  sender.number = 5000;
  source.refused(sender);
  EXPECT_EQ(state_of(source), SourceState::only_refused);
  EXPECT_EQ(source.statistics().last_refused, sender);
  EXPECT_EQ(source.statistics().waiting_for, "");

  EXPECT_EQ(source.malformed(), Event::malformed);
  EXPECT_EQ(state_of(source), SourceState::nothing_valid);
  source.refused(sender);
  EXPECT_EQ(state_of(source), SourceState::nothing_valid);

  EXPECT_EQ(source.sample(sample_of(test::params(1))), Event::sample);
  EXPECT_EQ(state_of(source), SourceState::receiving);
  source.malformed();
  source.refused(sender);
  const auto statistics = source.statistics();
  EXPECT_EQ(statistics.state, SourceState::receiving);
  EXPECT_EQ(statistics.records, 1u);
  EXPECT_EQ(statistics.malformed, 2u);
  EXPECT_EQ(statistics.refused, 3u);
  EXPECT_EQ(statistics.overwritten, 5u) << "what the kind of source adds";
}

TEST(CountedSource, AnEndIsPermanent) {
  Scripted source;
  source.sample(sample_of(test::params(1)));
  EXPECT_EQ(source.final_event(), Event::sample);
  EXPECT_EQ(source.ended(), Event::ended);
  EXPECT_EQ(source.ended(), Event::ended);
  EXPECT_EQ(source.final_event(), Event::ended);
  EXPECT_EQ(state_of(source), SourceState::ended);
  EXPECT_EQ(source.statistics().error, "");
}

TEST(CountedSource, AFailureNamesTheSourceAndTheReason) {
  Scripted source;
  source.sample(sample_of(test::params(1)));
  EXPECT_EQ(source.failed(EIO), Event::failed);
  EXPECT_EQ(source.final_event(), Event::failed);
  EXPECT_EQ(state_of(source), SourceState::failed);
  EXPECT_EQ(source.statistics().error, "scripted: Input/output error");
  EXPECT_EQ(source.statistics().records, 1u);
}

TEST(CountedSource, StopHasPriorityOverEveryEnd) {
  Scripted source;
  source.ended();
  source.stop();
  EXPECT_EQ(source.final_event(), Event::stopped);
  EXPECT_EQ(state_of(source), SourceState::ended)
      << "stopping is requested by the reader and is no state of the source";
}

TEST(CountedSource, UnknownFormatBitsAreOfParametersOnly) {
  Scripted source;
  auto params = test::params(1);
  source.sample(sample_of(params));
  EXPECT_EQ(source.statistics().unknown_format_bits, 0u);
  params.format |= 0x400;
  source.sample(sample_of(params));
  source.sample(sample_of(test::constants()));
  EXPECT_EQ(source.statistics().unknown_format_bits, 1u);
  EXPECT_EQ(source.statistics().records, 3u);
}

TEST(CountedSource, RecordsAcceptedDespiteAFaultAreCounted) {
  Scripted source;
  auto doubtful = sample_of(test::params(1));
  doubtful.doubt = "wrong checksum";
  source.sample(doubtful);
  source.sample(sample_of(test::params(2)));
  EXPECT_EQ(source.statistics().doubtful, 1u);
  EXPECT_STREQ(source.statistics().last_doubt, "wrong checksum") << "of the last that had one";
  EXPECT_EQ(source.statistics().records, 2u);
}

TEST(CountedSource, AsAReaderOfASourceSeesIt) {
  test::MemoryFeed feed;
  const auto source = feed.source();
  Reception reception;
  EXPECT_EQ(state_of(*source), SourceState::waiting);
  feed.put_malformed(wire::Reason::truncated);
  feed.put(test::params(1));
  feed.put(Event::failed);
  ASSERT_EQ(test::next(*source, reception), Event::malformed);
  EXPECT_EQ(state_of(*source), SourceState::nothing_valid);
  ASSERT_EQ(test::next(*source, reception), Event::sample);
  EXPECT_EQ(state_of(*source), SourceState::receiving);
  ASSERT_EQ(test::next(*source, reception), Event::failed);
  feed.put(test::params(2));
  EXPECT_EQ(test::next(*source, reception), Event::failed) << "whatever follows";
  EXPECT_THAT(source->statistics().error, HasSubstr("memory: "));
}

}  // namespace trk_bridge::transport::counted_source_test
