// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Slots in arbitrary states: whatever is done to them, sources and sinks check once, continue, and can be stopped.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "camera_records.h"
#include "deadline.h"
#include "free_slot.h"
#include "shm/segment.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::shm::shm_hostile_test {

using namespace std::chrono_literals;
using endpoints::open_sink;
using endpoints::open_source;
using transport::Event;
using transport::Reception;
using transport::Source;
using transport::SourceState;
using Clock = std::chrono::steady_clock;

using test::params;

/// The shortest of several durations of `work`, which hardly depends on the load of the machine.
Clock::duration least_time_of(const std::function<void()>& work) {
  auto least = Clock::duration::max();
  for (int i = 0; i < 10; ++i) {
    const auto begin = Clock::now();
    work();
    least = std::min(least, Clock::now() - begin);
  }
  return least;
}

/// Changes the slot repeatedly in a thread, until it is destroyed.
class Attack {
 public:
  explicit Attack(std::function<void()> blow)
      : thread_([this, blow = std::move(blow)] {
          while (!ended_) {
            blow();
            ++blows_;
          }
        }) {}
  ~Attack() {
    ended_ = true;
    thread_.join();
  }
  Attack(const Attack&) = delete;
  Attack& operator=(const Attack&) = delete;

  void wait_for(std::uint64_t blows) const {
    while (blows_ < blows) std::this_thread::yield();
  }

 private:
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> blows_{0};
  std::thread thread_;
};

class Hostile : public ::testing::Test {
 protected:
  const std::string& url() const { return url_; }

  /// In every state of the slot, a source that waits without a limit is stopped at once.
  void expect_stoppable(Source& source) {
    std::thread receiver([&source] {
      Reception received;
      while (source.receive(received, -1ns) != Event::stopped) {
      }
    });
    std::this_thread::sleep_for(50ms);
    const auto begin = Clock::now();
    source.stop();
    receiver.join();
    EXPECT_LT(Clock::now() - begin, 1s);
  }

  test::FreeSlot slot;
  const std::string url_ = "shm:" + std::to_string(slot.number());
  Reception into;
};

// Far more than a check takes, and far less than the 200 ms that a writer may need to create a segment.
constexpr auto no_waiting = 50ms;

TEST_F(Hostile, a_segment_that_is_never_finished_does_not_block_a_writer) {
  slot.make_segment(544);
  const auto sink = endpoints::parse_sink(url())->open();
  EXPECT_LT(least_time_of([&] { EXPECT_FALSE(sink->write(params(1))); }), no_waiting);
  EXPECT_EQ(sink->write(params(1)).error().reason, transport::SinkReason::no_segment);
  slot.remove();
  EXPECT_TRUE(sink->write(params(2))) << "every write checks again";
}

TEST_F(Hostile, a_slot_that_changes_all_the_time_blocks_nobody) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  std::mt19937 random(1);
  const Attack attack([&] {
    slot.remove();
    try {
      const std::size_t sizes[] = {300, 508, 524, 528, 544, 8192};
      const int id = slot.make_segment(sizes[random() % 6], random() % 4 == 0 ? 0 : 0666);
      auto* memory = static_cast<char*>(::shmat(id, nullptr, 0));
      if (memory == reinterpret_cast<char*>(-1)) return;
      if (random() % 2 == 0) {
        const std::uint64_t magic = segment_magic;
        std::memcpy(memory, &magic, sizeof magic);
      }
      for (int i = 12; i < 300; ++i) memory[i] = static_cast<char>(random());
      std::this_thread::sleep_for(1ms);
      ::shmdt(memory);
    } catch (const std::runtime_error&) {  // the code under test was faster
    }
  });
  attack.wait_for(20);
  EXPECT_LT(least_time_of([&] { static_cast<void>(sink->write(params(1))); }), no_waiting);
  EXPECT_LT(least_time_of([&] { static_cast<void>(source->receive(into, 0s)); }), no_waiting);
  expect_stoppable(*source);
}

TEST_F(Hostile, a_segment_that_changes_faster_than_it_can_be_copied_is_reported_and_polled_slowly) {
  const auto writer = Segment::attach_or_create(slot.number(), *layout_of_size(544), 0666);
  ASSERT_TRUE(writer);
  const auto source = open_source(url());
  auto* memory = static_cast<char*>(::shmat(writer->id(), nullptr, 0));
  {
    const Attack attack(
        [&] { __atomic_fetch_add(reinterpret_cast<std::uint16_t*>(memory + 12), 1, __ATOMIC_RELAXED); });
    attack.wait_for(1000);
    const auto begin = Clock::now();
    std::uint64_t events = 0;
    while (Clock::now() - begin < 300ms) {
      const Event event = source->receive(into, 10ms);
      ASSERT_NE(event, Event::sample);
      if (event == Event::malformed) ++events;
    }
    const auto looks = static_cast<std::uint64_t>((Clock::now() - begin) / 250us);
    EXPECT_GT(events, 0U);
    EXPECT_LE(events, looks + 1) << "one check in 250 us";
    EXPECT_EQ(source->statistics().state, SourceState::nothing_valid);
    expect_stoppable(*source);
  }
  ::shmdt(memory);
}

TEST_F(Hostile, a_segment_without_permission_is_named) {
  slot.make_segment(544, 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(98);  // root has all permissions
    const auto source = open_source(url());
    const bool is_idle = source->receive(into, 0s) == Event::idle;
    const bool is_named = source->statistics().waiting_for.find("Permission denied") != std::string::npos;
    ::_exit(!is_idle ? 1 : !is_named ? 2 : source->statistics().state == SourceState::nothing_valid ? 0 : 3);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace trk_bridge::shm::shm_hostile_test
