// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "waiting.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <ctime>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "base/system_text.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

// Longer waits are treated as endless: the clock could not represent their end.
constexpr nanoseconds longest_wait = std::chrono::hours(24 * 365 * 100);

}  // namespace

StopEvent::StopEvent() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (fd_ < 0) throw TransportError("no descriptor for waiting: " + base::system_text(errno));
}

StopEvent::~StopEvent() { ::close(fd_); }

void StopEvent::set() noexcept {
  const int saved = errno;
  set_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  // The write can fail only if the counter is full; then the descriptor is already readable.
  [[maybe_unused]] const ssize_t written = ::write(fd_, &one, sizeof one);
  errno = saved;
}

Deadline::Deadline(nanoseconds wait) noexcept : endless_(wait < nanoseconds::zero() || wait > longest_wait) {
  if (!endless_) at_ = steady_clock::now() + wait;
}

nanoseconds Deadline::left() const noexcept {
  return std::max(nanoseconds::zero(), nanoseconds(at_ - steady_clock::now()));
}

Wake wait_readable(int fd, const StopEvent& stop, const Deadline& deadline) noexcept {
  std::array<pollfd, 2> watched{{{fd, POLLIN, 0}, {stop.fd(), POLLIN, 0}}};
  for (;;) {
    timespec timeout{};
    if (!deadline.is_endless()) {
      const auto left = deadline.left();
      const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
      timeout.tv_sec = static_cast<time_t>(seconds.count());
      timeout.tv_nsec = static_cast<long>((left - seconds).count());
    }
    const int ready = ::ppoll(watched.data(), watched.size(), deadline.is_endless() ? nullptr : &timeout, nullptr);
    if (stop.is_set()) return Wake::stopped;
    if (ready > 0) return Wake::readable;
    if (ready == 0) return Wake::timeout;
    if (errno != EINTR) return Wake::failed;
  }
}

}  // namespace trk_bridge::transport
