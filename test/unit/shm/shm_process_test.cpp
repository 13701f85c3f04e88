// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Several processes on one slot: fast ones, and ones that are killed at any moment.
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "free_slot.h"
#include "shm/segment.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::shm::shm_process_test {

using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto deadline = 40s;

/// Every field contains the counter, so that a mix of two records is recognised.
wire::CameraParams params(std::uint64_t counter) {
  const auto n = static_cast<double>(counter);
  wire::CameraParams p;
  p.format = wire::euler;
  p.euler = {n, n, n, n, n, n};
  p.fov = p.center_x = p.center_y = p.k1 = p.k2 = p.focdist = p.aperture = n;
  p.counter = counter;
  return p;
}

bool is_whole(const wire::CameraParams& p) { return p == params(p.counter); }

/// A process that ends with the test in any case.
class Child {
 public:
  explicit Child(const std::function<int()>& work) : pid_(::fork()) {
    if (pid_ == 0) {
      int code = 99;
      try {
        code = work();
      } catch (const std::exception&) {
        code = 98;
      }
      ::_exit(code);
    }
  }
  ~Child() {
    if (!ended_) end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Like kill -9.
  void end() {
    ::kill(pid_, SIGKILL);
    wait();
  }
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
  bool ended_ = false;
};

std::string url_of(const test::FreeSlot& slot) { return "shm:" + std::to_string(slot.number()); }

/// Reads until `last` is received. 0 if all records were consistent and in order.
int read_to(const std::string& url, std::uint64_t last) {
  const auto source = open_source(url);
  Reception into;
  std::uint64_t newest = 0;
  const auto end = Clock::now() + deadline;
  while (Clock::now() < end) {
    const Event event = source->receive(into, 10ms);
    if (event == Event::malformed) return 3;
    if (event != Event::sample) continue;
    const auto* p = std::get_if<wire::CameraParams>(&into.sample.record);
    if (p == nullptr) continue;
    if (!is_whole(*p)) return 1;
    if (p->counter <= newest) return 2;
    newest = p->counter;
    if (newest == last) return 0;
  }
  return 4;
}

bool wait_for(const std::function<bool()>& condition) {
  const auto end = Clock::now() + deadline;
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::yield();
  }
  return true;
}

TEST(ShmProcesses, a_reader_in_another_process_gets_what_is_written) {
  test::FreeSlot slot;
  Child reader([&] { return read_to(url_of(slot), 500); });
  const auto sink = open_sink(url_of(slot));
  ASSERT_TRUE(wait_for([&] { return Segment::attach(slot.number())->connected() == 3; })) << "reader attached";
  for (std::uint64_t i = 1; i <= 500; ++i) ASSERT_TRUE(sink->write(params(i)));
  EXPECT_EQ(reader.wait(), 0);
}

// The readers read without a pause, so that they often read during a write; the writer continues until all have read
// enough.
TEST(ShmProcesses, eight_readers_of_one_fast_writer_never_see_a_torn_record) {
  // With only one free core a reader gets one new record each time it is scheduled.
  constexpr int enough = 200;
  constexpr std::uint64_t least_writes = 200'000;
  test::FreeSlot slot;
  auto writer = Segment::attach_or_create(slot.number(), *layout_of_size(528), 0666);
  ASSERT_TRUE(writer);
  const auto look = [&] {
    const auto segment = Segment::attach(slot.number());
    if (!segment) return 5;
    RecordImage image;
    const auto end = Clock::now() + deadline;
    int copies = 0;
    for (std::uint16_t seen = 0; copies < enough;) {
      if (Clock::now() > end) return 4;
      if (segment->params_counter() == seen || !segment->copy_params(image)) continue;
      const auto p = wire::params_from_image(image.view(), segment->layout().record);
      if (!p) return 3;
      if (!is_whole(*p)) return 1;
      if (static_cast<std::uint16_t>(p->counter) != image.counter) return 2;
      seen = image.counter;
      ++copies;
    }
    return 0;
  };
  std::vector<std::unique_ptr<Child>> readers;
  for (int i = 0; i < 8; ++i) readers.push_back(std::make_unique<Child>(look));
  // Each reader has the writer's attachment, inherited by fork(), and another one.
  ASSERT_TRUE(wait_for([&] { return writer->attachments() == 1 + 2 * readers.size(); }));
  const auto end = Clock::now() + deadline;
  std::uint64_t written = 0;
  while ((written < least_writes || writer->attachments() > 1) && Clock::now() < end) {
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(writer->write(params(++written)));
  }
  for (auto& reader : readers) EXPECT_EQ(reader->wait(), 0);
  EXPECT_GE(written, least_writes);
}

TEST(ShmProcesses, killed_writers_leave_complete_records_and_a_usable_slot) {
  test::FreeSlot slot;
  const auto source = open_source(url_of(slot));
  Reception into;
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    Child writer([&] {
      const auto sink = open_sink(url_of(slot));
      for (std::uint64_t i = 1;; ++i) {
        if (!sink->write(params(i))) return 1;
      }
    });
    const int enough = std::uniform_int_distribution<int>(1, 40)(random);
    int received = 0;
    const auto end = Clock::now() + deadline;
    while (received < enough && Clock::now() < end) {
      const Event event = source->receive(into, 10ms);
      ASSERT_NE(event, Event::malformed) << describe(into.fault);
      if (event != Event::sample) continue;
      ASSERT_TRUE(is_whole(std::get<wire::CameraParams>(into.sample.record)));
      ++received;
    }
    ASSERT_EQ(received, enough) << "round " << round << ": " << source->statistics().waiting_for;
    writer.end();
  }
  EXPECT_EQ(Segment::attach(slot.number())->connected(), 2) << "dead processes are not counted";
}

TEST(ShmProcesses, killed_readers_do_not_count_as_attached) {
  test::FreeSlot slot;
  auto sink = open_sink(url_of(slot));
  for (int round = 0; round < 20; ++round) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    Child reader([&] {
      // The writer's attachment was inherited by fork(); it ends with the process.
      const auto source = open_source(url_of(slot));
      Reception into;
      if (::write(ready[1], "x", 1) != 1) return 1;
      for (;;) {
        if (source->receive(into, 1s) == Event::malformed) return 2;
      }
    });
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    for (std::uint64_t i = 1; i <= 50; ++i) ASSERT_TRUE(sink->write(params(i)));
    reader.end();
    ::close(ready[0]);
    ::close(ready[1]);
  }
  sink.reset();
  EXPECT_EQ(slot.segment(), -1);
  EXPECT_FALSE(slot.has_file());
}

TEST(ShmProcesses, a_segment_whose_creator_crashed_is_taken_over) {
  test::FreeSlot slot;
  Child maker([&] {
    slot.make_segment(544);
    return 0;
  });
  ASSERT_EQ(maker.wait(), 0);
  const int id = slot.segment();
  ASSERT_GE(id, 0);
  const auto sink = open_sink(url_of(slot));
  EXPECT_EQ(slot.segment(), id);
  const auto reader = Segment::attach(slot.number());
  ASSERT_TRUE(reader) << describe(reader.error());
  EXPECT_EQ(reader->layout().size, 544U);
  EXPECT_EQ(reader->connected(), 2);
}

TEST(ShmProcesses, concurrent_opening_and_closing_loses_nothing) {
  test::FreeSlot slot;
  const auto open_and_close = [&] {
    for (int i = 0; i < 300; ++i) {
      auto segment = Segment::attach_or_create(slot.number(), *layout_of_size(528), 0666);
      const auto end = Clock::now() + deadline;
      while (!segment && is_transient(segment.error().problem) && Clock::now() < end) {
        segment = Segment::attach_or_create(slot.number(), *layout_of_size(528), 0666);
      }
      if (!segment) return 10 + static_cast<int>(segment.error().problem);
      if (!segment->write(params(1))) return 1;
    }
    return 0;
  };
  Child first(open_and_close), second(open_and_close), third(open_and_close);
  EXPECT_EQ(first.wait(), 0);
  EXPECT_EQ(second.wait(), 0);
  EXPECT_EQ(third.wait(), 0);
  EXPECT_EQ(slot.segment(), -1);
  EXPECT_FALSE(slot.has_file());
}

TEST(ShmProcesses, a_forked_copy_of_a_handle_does_not_count_down) {
  test::FreeSlot slot;
  auto segment = Segment::attach_or_create(slot.number(), *layout_of_size(528), 0666);
  ASSERT_TRUE(segment);
  Child copy([&] {
    segment->close();
    return 0;
  });
  ASSERT_EQ(copy.wait(), 0);
  EXPECT_EQ(segment->connected(), 1);
  EXPECT_EQ(slot.segment(), segment->id());
}

}  // namespace trk_bridge::shm::shm_process_test
