// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "process.h"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <ctime>

#include <fcntl.h>
#include <unistd.h>

namespace trk_bridge::base {
namespace {

using Stop = void (*)();

constexpr std::int64_t grace = 2'000'000'000;  // ns

std::atomic<Stop> to_call{nullptr};
std::atomic<std::int64_t> first{0};  // when the first signal was received, ns; 0: none
static_assert(std::atomic<Stop>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler must not wait for a lock");

std::int64_t now() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

extern "C" void trk_bridge_stop(int number) {
  const int error = errno;
  const std::int64_t time = now();
  std::int64_t before = 0;
  if (first.compare_exchange_strong(before, time)) {
    if (const Stop stop = to_call.load()) stop();
  } else if (time - before > grace) {
    // It is delivered when this handler returns.
    ::signal(number, SIG_DFL);
    ::raise(number);
  }
  errno = error;
}

}  // namespace

StopSignals::StopSignals(void (*stop)()) {
  first.store(0);
  to_call.store(stop);
  struct sigaction action {};
  action.sa_handler = trk_bridge_stop;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, &interrupt_);
  ::sigaction(SIGTERM, &action, &terminate_);
}

StopSignals::~StopSignals() {
  to_call.store(nullptr);
  if (received()) return;
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
}

bool StopSignals::received() noexcept { return first.load() != 0; }

void open_standard_descriptors() noexcept {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    // open() uses the lowest free descriptor, which is this one.
    if (::fcntl(fd, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

}  // namespace trk_bridge::base
