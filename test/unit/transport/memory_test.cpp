// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "memory.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "trk_bridge/transport/sink.h"
#include "udp.h"

namespace trk_bridge::transport::memory_test {

using test::next;
using test::next_counter;

TEST(Memory, WhatIsWrittenIsRead) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  const auto sink = std::make_unique<test::MemorySink>(queue);
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  ASSERT_TRUE(sink->write(test::constants(1920, 2)));
  ASSERT_TRUE(sink->write(test::params(7, 2)));
  Reception reception;
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(reception.sample.record), test::constants(1920, 2));
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(7, 2));
  EXPECT_EQ(to_string(reception.sample.sender), "memory");
  EXPECT_GT(reception.sample.arrival, 1'600'000'000'000'000'000);
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), Event::idle);
  EXPECT_EQ(source->statistics().records, 2u);
  EXPECT_EQ(source->statistics().state, SourceState::receiving);
  EXPECT_EQ(sink->statistics().params, 1u);
  EXPECT_EQ(sink->statistics().constants, 1u);
}

TEST(Memory, NothingIsLost) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  const auto sink = std::make_unique<test::MemorySink>(queue);
  for (std::uint64_t i = 0; i < 5000; ++i) ASSERT_TRUE(sink->write(test::params(i)));
  for (std::uint64_t i = 0; i < 5000; ++i) ASSERT_EQ(next_counter(*source), i);
}

TEST(Memory, AWriteWakesAWaitingReader) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  const auto sink = std::make_unique<test::MemorySink>(queue);
  auto counter = std::async(std::launch::async, [&source] { return next_counter(*source); });
  ASSERT_TRUE(sink->write(test::params(3)));
  EXPECT_EQ(counter.get(), 3u);
}

TEST(Memory, StopWakesAndIsPermanent) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  const auto sink = std::make_unique<test::MemorySink>(queue);
  auto event = std::async(std::launch::async, [&source] {
    Reception reception;
    return source->receive(reception, std::chrono::nanoseconds(-1));
  });
  source->stop();
  EXPECT_EQ(event.get(), Event::stopped);
  ASSERT_TRUE(sink->write(test::params(3)));
  Reception reception;
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds(-1)), Event::stopped);
}

TEST(Memory, AClosedSinkReportsIt) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto sink = std::make_unique<test::MemorySink>(queue);
  ASSERT_TRUE(sink->close());
  EXPECT_EQ(sink->write(test::params(1)).error().reason, SinkReason::closed);
  EXPECT_EQ(sink->write(test::constants()).error().reason, SinkReason::closed);
  EXPECT_EQ(sink->statistics().errors, 2u);
}

TEST(Memory, TestsMayPutAnythingInTheQueue) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  test::MemoryQueue::Entry entry;
  entry.event = Event::malformed;
  entry.reception.fault = wire::Fault{wire::Reason::bad_magic};
  entry.reception.sample.arrival = 12;
  queue->push(entry);
  entry.event = Event::sample;
  entry.reception.sample.record = test::params(4);
  entry.reception.sample.arrival = 34;
  queue->push(entry);
  entry.event = Event::ended;
  queue->push(entry);

  Reception reception;
  ASSERT_EQ(next(*source, reception), Event::malformed);
  EXPECT_STREQ(reception.fault.name(), wire::name(wire::Reason::bad_magic));
  EXPECT_EQ(reception.sample.arrival, 12);
  EXPECT_EQ(source->statistics().state, SourceState::nothing_valid);
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(reception.sample.arrival, 34);
  EXPECT_EQ(next(*source, reception), Event::ended);
  EXPECT_EQ(next(*source, reception), Event::ended) << "an end remains";
  EXPECT_EQ(source->statistics().state, SourceState::ended);
}

TEST(Memory, ManyWritersManyRecords) {
  const auto queue = std::make_shared<test::MemoryQueue>();
  const auto source = std::make_unique<test::MemorySource>(queue);
  constexpr std::uint64_t each = 500;
  std::vector<std::thread> writers;
  for (std::uint32_t id = 1; id <= 4; ++id) {
    writers.emplace_back([id, queue] {
      const auto sink = std::make_unique<test::MemorySink>(queue);
      for (std::uint64_t i = 0; i < each; ++i) EXPECT_TRUE(sink->write(test::params(i, id)));
    });
  }
  std::array<std::uint64_t, 5> expected{};
  Reception reception;
  for (std::uint64_t i = 0; i < 4 * each; ++i) {
    ASSERT_EQ(next(*source, reception), Event::sample);
    const auto& p = std::get<wire::CameraParams>(reception.sample.record);
    ASSERT_EQ(p.counter, expected.at(p.id)++) << "each writer's records in their order";
  }
  for (auto& writer : writers) writer.join();
}

}  // namespace trk_bridge::transport::memory_test
