// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A lock that costs one atomic operation if no other thread holds it.
#pragma once

#include <atomic>
#include <chrono>

#include <sched.h>

namespace trk_bridge::c_api {

/// Stores the thread that holds it, so that a signal handler that interrupted this thread does not wait forever. A
/// waiting thread yields the processor: calls on one handle from several threads are rare.
class HandleLock {
 public:
  /// Locks. False if this thread already holds the lock.
  bool wait() noexcept {
    const void* holder = nullptr;
    while (!holder_.compare_exchange_weak(holder, self(), std::memory_order_acquire, std::memory_order_relaxed)) {
      if (holder == self()) return false;
      if (holder != nullptr) ::sched_yield();
      holder = nullptr;
    }
    return true;
  }

  /// False if it did not become free within `most`.
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
    // Used in every call: this model needs no function call.
    static thread_local char me __attribute__((tls_model("initial-exec")));
    return &me;
  }

  std::atomic<const void*> holder_{nullptr};
};

}  // namespace trk_bridge::c_api
