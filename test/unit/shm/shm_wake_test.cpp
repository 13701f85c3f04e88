// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writers of this package wake waiting readers; existing programs do not know about waiting readers.
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <future>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "camera_records.h"
#include "deadline.h"
#include "field_program.h"
#include "free_slot.h"
#include "shm/segment.h"
#include "system_calls.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::shm::shm_wake_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::FieldProgram;
using test::params;
using test::SystemCalls;
using transport::Event;
using transport::Reception;
using transport::Source;

using namespace std::chrono_literals;

const SegmentLayout& layout() { return *layout_of(default_layout); }

/// The memory of a segment, like in another process.
class Memory {
 public:
  explicit Memory(int id) : base_(static_cast<char*>(::shmat(id, nullptr, 0))) {}
  ~Memory() { ::shmdt(base_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  std::uint32_t word(std::size_t at) const {
    return __atomic_load_n(reinterpret_cast<std::uint32_t*>(base_ + at), __ATOMIC_SEQ_CST);
  }
  std::uint32_t announcement() const { return word(1024); }
  std::uint32_t wake_word() const { return word(1028); }

 private:
  char* base_;
};

/// Receives the counters of parameters in a thread.
class Receiver {
 public:
  explicit Receiver(Source& source) : source_(source), thread_([this] { run(); }) {}
  ~Receiver() {
    source_.stop();
    thread_.join();
  }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  bool gets(std::uint64_t counter) {
    return test::becomes_true([&] { return last_ == counter; });
  }

 private:
  void run() {
    Reception reception;
    while (source_.receive(reception, -1ns) == Event::sample) {
      const auto* p = std::get_if<wire::CameraParams>(&reception.sample.record);
      if (p != nullptr) last_ = p->counter;
    }
  }

  Source& source_;
  std::atomic<std::uint64_t> last_{0};
  std::thread thread_;
};

class ShmWake : public ::testing::Test {
 protected:
  std::string url() const { return "shm:" + std::to_string(slot.number()); }
  Segment make() const { return Segment::attach_or_create(slot.number(), layout(), 0666).value(); }

  test::FreeSlot slot;
};

TEST_F(ShmWake, the_area_behind_a_segment_is_shared_and_empty_when_new) {
  auto segment = make();
  shmid_ds state{};
  ASSERT_EQ(::shmctl(segment.id(), IPC_STAT, &state), 0);
  EXPECT_EQ(state.shm_segsz, 544U) << "the size that existing programs request";
  const Memory other(segment.id());
  EXPECT_EQ(other.announcement(), 0U);
  EXPECT_EQ(other.wake_word(), 0U);
  EXPECT_FALSE(segment.is_announced());
  ASSERT_TRUE(segment.write(params(5)));
  EXPECT_EQ(other.announcement(), 0x77610001U) << "the mark and the write counter";
  EXPECT_TRUE(segment.is_announced());
}

TEST_F(ShmWake, sets_of_existing_programs_are_not_announced) {
  auto segment = make();
  FieldProgram field(slot, layout());
  ASSERT_TRUE(field.open());
  for (std::uint64_t i = 0; i < 100; ++i) {
    field.write(params(i));
    ASSERT_FALSE(segment.is_announced());
    ASSERT_TRUE(segment.write(params(i)));
    ASSERT_TRUE(segment.is_announced());
  }
  // Until the write counter wraps.
  for (std::uint64_t i = 1; i < 65500; ++i) {
    field.write(params(i));
    ASSERT_FALSE(segment.is_announced()) << i;
  }
}

TEST_F(ShmWake, a_write_wakes_once_and_only_waiting_readers) {
  auto segment = make();
  const Memory other(segment.id());
  const auto waiter = segment.wait_for_write();
  EXPECT_EQ(*waiter.word, waiter.value);
  EXPECT_EQ(segment.wait_for_write().value, waiter.value) << "they wait for the same";
  ASSERT_TRUE(segment.write(params(1)));
  const std::uint32_t after = other.wake_word();
  EXPECT_NE(after, waiter.value);
  ASSERT_TRUE(segment.write(params(2)));
  EXPECT_EQ(other.wake_word(), after) << "no reader waits any more";
  EXPECT_NE(segment.wait_for_write().value, waiter.value);
  ASSERT_TRUE(segment.write(test::constants()));
  EXPECT_NE(other.wake_word(), after) << "constants wake as well";
}

TEST_F(ShmWake, a_write_is_no_system_call_if_nobody_waits) {
  bool is_permitted = true;
  const auto calls_of_100 = [&](bool has_dead_waiter) {
    return test::system_calls_of(
        [&](const auto& counted) {
          auto segment = make();
          if (has_dead_waiter) (void)segment.wait_for_write();
          bool well = true;
          counted([&] {
            for (std::uint64_t i = 0; i < 100; ++i) well = well && segment.write(params(i));
          });
          return well;
        },
        is_permitted);
  };
  const auto alone = calls_of_100(false);
  if (!is_permitted) GTEST_SKIP() << "tracing processes is not permitted here";
  EXPECT_EQ(alone, SystemCalls{});
  EXPECT_EQ(calls_of_100(true), (SystemCalls{{SYS_futex, 1}})) << "a reader that died while it waited costs one call";
}

TEST_F(ShmWake, each_set_of_our_writer_is_received) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  Receiver receiver(*source);
  // With polling only, ten times a second, this would take half a minute.
  for (std::uint64_t i = 1; i <= 300; ++i) {
    ASSERT_TRUE(sink->write(params(i)));
    ASSERT_TRUE(receiver.gets(i)) << i;
  }
  EXPECT_EQ(source->statistics().overwritten, 0U);
}

TEST_F(ShmWake, an_existing_writer_beside_ours_is_not_missed) {
  const auto sink = open_sink(url());
  const auto source = open_source(url());
  FieldProgram field(slot, layout());
  ASSERT_TRUE(field.open());
  Receiver receiver(*source);
  for (std::uint64_t i = 1; i <= 60; ++i) {
    if (i % 3 == 0) {
      field.write(params(i));
    } else {
      ASSERT_TRUE(sink->write(params(i)));
    }
    ASSERT_TRUE(receiver.gets(i)) << i;
  }
  EXPECT_EQ(source->statistics().overwritten, 0U);
}

TEST_F(ShmWake, a_reader_asleep_is_stopped) {
  const auto sink = open_sink(url());
  for (const bool writer_wakes : {false, true}) {
    const auto source = open_source(url());
    Reception reception;
    if (writer_wakes) {
      ASSERT_TRUE(sink->write(params(1)));
      ASSERT_EQ(source->receive(reception, test::deadline), Event::sample);
    }
    const Memory other(slot.segment());
    auto event = std::async(std::launch::async, [&] { return source->receive(reception, -1ns); });
    EXPECT_TRUE(test::becomes_true([&] { return other.wake_word() % 2 == 1; })) << "it waits";
    source->stop();
    EXPECT_EQ(event.wait_for(test::deadline), std::future_status::ready);
    EXPECT_EQ(event.get(), Event::stopped);
  }
}

/// Like on Linux before 5.16.
bool forbid_futex_waitv() {
  std::array<sock_filter, 4> program{{
      {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
      {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 449},
      {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | ENOSYS},
      {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
  }};
  const sock_fprog filter{program.size(), program.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

TEST_F(ShmWake, if_the_system_cannot_wait_for_two_things_the_reader_polls) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (!forbid_futex_waitv()) ::_exit(2);
    const auto sink = open_sink(url());
    const auto source = open_source(url());
    int lost = 0;
    {
      Receiver receiver(*source);
      for (std::uint64_t i = 1; i <= 100 && lost == 0; ++i) {
        if (!sink->write(params(i)) || !receiver.gets(i)) ++lost;
      }
    }
    ::_exit(lost == 0 && source->statistics().overwritten == 0 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "system calls cannot be blocked here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace trk_bridge::shm::shm_wake_test
