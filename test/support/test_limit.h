// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A time limit for each test of a program.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace trk_bridge::test {

/// Ends the program if a test takes longer than the limit, because it would hang for ever.
class TestLimit : public ::testing::EmptyTestEventListener {
 public:
  explicit TestLimit(std::chrono::seconds limit) : limit_(limit) {}

 private:
  void OnTestStart(const ::testing::TestInfo& test) override {
    ended_ = false;
    watch_ = std::thread([this, name = std::string(test.test_suite_name()) + "." + test.name()] {
      std::unique_lock lock(mutex_);
      if (end_.wait_for(lock, limit_, [this] { return ended_; })) return;
      std::fprintf(stderr, "%s has not ended after %ld seconds\n", name.c_str(), static_cast<long>(limit_.count()));
      std::_Exit(1);
    });
  }
  void OnTestEnd(const ::testing::TestInfo&) override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    end_.notify_one();
    watch_.join();
  }

  const std::chrono::seconds limit_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::thread watch_;
};

/// For every test of this program: longer than several waits of one test that all fail.
inline void limit_each_test() {
  ::testing::UnitTest::GetInstance()->listeners().Append(new TestLimit(std::chrono::seconds(600)));
}

}  // namespace trk_bridge::test
