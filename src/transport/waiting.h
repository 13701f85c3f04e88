// Waiting in the kernel for something to read, until a time, or until stopped from any thread or a signal handler.
#pragma once

#include <atomic>
#include <chrono>

namespace trk_bridge::transport {

/// Set once and for good. `fd()` is readable from then on, so that it can stand in any poll.
class StopEvent {
 public:
  /// Throws TransportError when the process has no descriptor left.
  StopEvent();
  ~StopEvent();
  StopEvent(const StopEvent&) = delete;
  StopEvent& operator=(const StopEvent&) = delete;

  /// Any thread, any number of times, safe in a signal handler; errno stays.
  void set() noexcept;
  bool is_set() const noexcept { return set_.load(std::memory_order_acquire); }
  int fd() const noexcept { return fd_; }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not meet a lock");
  std::atomic<bool> set_{false};
  int fd_;
};

/// A moment from now on; `wait` as in Source::receive.
class Deadline {
 public:
  explicit Deadline(std::chrono::nanoseconds wait) noexcept;

  bool is_endless() const noexcept { return endless_; }
  /// Not below zero.
  std::chrono::nanoseconds left() const noexcept;
  bool has_passed() const noexcept { return !endless_ && left() == std::chrono::nanoseconds::zero(); }

 private:
  bool endless_;
  std::chrono::steady_clock::time_point at_{};
};

enum class Wake { readable, stopped, timeout, failed };

/// For wait_readable(): never readable, so that only time and stop count.
inline constexpr int no_descriptor = -1;

/// `readable` also when the descriptor has an error to report; `failed` leaves the reason in errno.
[[nodiscard]] Wake wait_readable(int fd, const StopEvent& stop, const Deadline& deadline) noexcept;

}  // namespace trk_bridge::transport
