// A lock that costs one atomic operation where nobody else wants it.
#pragma once

#include <atomic>
#include <chrono>

#include <sched.h>

namespace trk_bridge::c_api {

/// Knows its thread, so that a signal handler that interrupted the holder does not wait for ever. Who waits gives the
/// processor away: calls on one handle from several threads are rare.
class TurnLock {
 public:
  /// Waits for the lock. False where this thread has it already.
  bool wait() noexcept {
    const void* holder = nullptr;
    while (!holder_.compare_exchange_weak(holder, self(), std::memory_order_acquire, std::memory_order_relaxed)) {
      if (holder == self()) return false;
      if (holder != nullptr) ::sched_yield();
      holder = nullptr;
    }
    return true;
  }

  /// False where it was not free within `most`.
  bool wait_for(std::chrono::nanoseconds most) noexcept {
    const auto end = std::chrono::steady_clock::now() + most;
    for (;;) {
      const void* nobody = nullptr;
      if (holder_.compare_exchange_strong(nobody, self(), std::memory_order_acquire)) return true;
      if (std::chrono::steady_clock::now() > end) return false;
      ::sched_yield();
    }
  }

  bool is_mine() const noexcept { return holder_.load(std::memory_order_relaxed) == self(); }
  void unlock() noexcept { holder_.store(nullptr, std::memory_order_release); }

 private:
  static const void* self() noexcept {
    // Read at every call: the model without a function call.
    static thread_local char me __attribute__((tls_model("initial-exec")));
    return &me;
  }

  std::atomic<const void*> holder_{nullptr};
};

}  // namespace trk_bridge::c_api
