// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Waits in the kernel for data, for a time limit, or for a stop from any thread or a signal handler.
#pragma once

#include <atomic>
#include <chrono>

namespace trk_bridge::transport {

/// An event that is set once. `fd()` is readable from then on, for use in any poll.
class StopEvent {
 public:
  /// Throws TransportError if the process has no descriptor left.
  StopEvent();
  ~StopEvent();
  StopEvent(const StopEvent&) = delete;
  StopEvent& operator=(const StopEvent&) = delete;

  /// Any thread, any number of times, safe in a signal handler; errno is not changed.
  void set() noexcept;
  bool is_set() const noexcept { return set_.load(std::memory_order_acquire); }
  int fd() const noexcept { return fd_; }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait for a lock");
  std::atomic<bool> set_{false};
  int fd_;
};

/// A point in time, `wait` from now; `wait` as in Source::receive.
class Deadline {
 public:
  explicit Deadline(std::chrono::nanoseconds wait) noexcept;

  bool is_endless() const noexcept { return endless_; }
  /// Never negative.
  std::chrono::nanoseconds left() const noexcept;
  bool has_passed() const noexcept { return !endless_ && left() == std::chrono::nanoseconds::zero(); }

 private:
  bool endless_;
  std::chrono::steady_clock::time_point at_{};
};

enum class Wake { readable, stopped, timeout, failed };

/// For wait_readable(): never readable, so that it waits only for the deadline or a stop.
inline constexpr int no_descriptor = -1;

/// `readable` also if the descriptor has an error; for `failed`, the reason is in errno.
[[nodiscard]] Wake wait_readable(int fd, const StopEvent& stop, const Deadline& deadline) noexcept;

}  // namespace trk_bridge::transport
