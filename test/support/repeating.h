// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Repeats an action at a rate in its thread, until this object is destroyed.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace trk_bridge::test {

class Repeating {
 public:
  Repeating(double rate, std::function<void()> action)
      : period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate))),
        action_(std::move(action)),
        thread_([this] { run(); }) {}
  ~Repeating() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    end_.notify_one();
    thread_.join();
  }
  Repeating(const Repeating&) = delete;
  Repeating& operator=(const Repeating&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  void run() {
    auto next = Clock::now();
    std::unique_lock lock(mutex_);
    while (!ended_) {
      lock.unlock();
      action_();
      lock.lock();
      next += period_;
      end_.wait_until(lock, next, [this] { return ended_; });
    }
  }

  Clock::duration period_;
  std::function<void()> action_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace trk_bridge::test
