// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Ending a wait in the kernel from a thread and from a signal handler; and a tracker in another process.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <future>
#include <string>
#include <thread>

#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk::udp_stop_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::PlainSocket;
using test::port_of;
using transport::Event;
using transport::Reception;
using transport::Source;
using transport::TransportError;

/// A thread that waits in receive() without a limit; it is known to sleep in the kernel.
class Waiting {
 public:
  explicit Waiting(Source& source)
      : event_(std::async(std::launch::async, [this, &source] {
          thread_ = ::pthread_self();
          id_ = static_cast<int>(::syscall(SYS_gettid));
          Reception reception;
          return source.receive(reception, std::chrono::nanoseconds(-1));
        })) {
    const auto until = std::chrono::steady_clock::now() + test::deadline;
    while (!sleeps() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    EXPECT_TRUE(sleeps());
  }

  pthread_t thread() const { return thread_; }
  Event event() { return event_.wait_for(test::deadline) == std::future_status::ready ? event_.get() : Event::idle; }

 private:
  bool sleeps() const {
    if (id_ == 0) return false;
    std::ifstream status("/proc/self/task/" + std::to_string(id_.load()) + "/stat");
    std::string line;
    std::getline(status, line);
    const auto name_end = line.rfind(") ");
    return name_end != std::string::npos && line[name_end + 2] == 'S';
  }

  std::atomic<int> id_{0};
  std::atomic<pthread_t> thread_{};
  std::future<Event> event_;
};

TEST(UdpStop, AnotherThreadWakesIt) {
  const auto source = open_source("udp://127.0.0.1:0");
  Waiting waiting(*source);
  source->stop();
  EXPECT_EQ(waiting.event(), Event::stopped);
}

TEST(UdpStop, ASignalHandlerWakesIt) {
  static Source* target = nullptr;
  const auto source = open_source("udp://127.0.0.1:0");
  target = source.get();
  struct sigaction action {};
  action.sa_handler = [](int) { target->stop(); };
  struct sigaction before {};
  ASSERT_EQ(::sigaction(SIGUSR1, &action, &before), 0);
  Waiting waiting(*source);
  ASSERT_EQ(::pthread_kill(waiting.thread(), SIGUSR1), 0);
  EXPECT_EQ(waiting.event(), Event::stopped);
  ASSERT_EQ(::sigaction(SIGUSR1, &before, nullptr), 0);
}

TEST(UdpStop, IsPermanentWhateverIsQueued) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  tracker.send(test::datagram(test::params(1)), "127.0.0.1", port_of(*source));
  tracker.send(test::datagram(test::params(2)), "127.0.0.1", port_of(*source));
  EXPECT_EQ(test::next_counter(*source), 1u);
  source->stop();
  source->stop();
  Reception reception;
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds(-1)), Event::stopped);
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds(0)), Event::stopped);
}

TEST(UdpStop, AnUnrelatedSignalDoesNotWakeIt) {
  const auto source = open_source("udp://127.0.0.1:0");
  struct sigaction action {};
  action.sa_handler = [](int) {};
  struct sigaction before {};
  ASSERT_EQ(::sigaction(SIGUSR2, &action, &before), 0);
  Waiting waiting(*source);
  ASSERT_EQ(::pthread_kill(waiting.thread(), SIGUSR2), 0);
  const PlainSocket tracker;
  tracker.send(test::datagram(test::params(1)), "127.0.0.1", port_of(*source));
  EXPECT_EQ(waiting.event(), Event::sample);
  ASSERT_EQ(::sigaction(SIGUSR2, &before, nullptr), 0);
}

TEST(UdpProcesses, ATrackerInAnotherProcess) {
  const auto source = open_source("udp://127.0.0.1:0?buffer=1000000");
  const std::string url = "udp://127.0.0.1:" + std::to_string(port_of(*source)) + "?binary=1";
  constexpr std::uint64_t sets = 200;
  const pid_t tracker = ::fork();
  ASSERT_GE(tracker, 0);
  if (tracker == 0) {
    int failures = 0;
    try {
      const auto sink = open_sink(url);
      failures += sink->write(test::constants(1920, 3)) ? 0 : 1;
      for (std::uint64_t i = 0; i < sets; ++i) failures += sink->write(test::params(i, 3)) ? 0 : 1;
      failures += sink->close() ? 0 : 1;
    } catch (const TransportError&) {
      failures = 255;
    }
    ::_exit(failures);
  }
  Reception reception;
  ASSERT_EQ(test::next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(reception.sample.record), test::constants(1920, 3));
  for (std::uint64_t i = 0; i < sets; ++i) {
    ASSERT_EQ(test::next(*source, reception), Event::sample);
    ASSERT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(i, 3));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(tracker, &status, 0), tracker);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace trk_bridge::trk::udp_stop_test
