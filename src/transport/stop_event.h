// What ends a wait in the kernel from any thread and from a signal handler.
#pragma once

#include <atomic>

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

}  // namespace trk_bridge::transport
