// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A launch file, as a user starts it.
#pragma once

#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "program.h"

namespace trk_bridge::test {

/// roslaunch and all its nodes, ended by the destructor at the latest.
class Roslaunch {
 public:
  explicit Roslaunch(const std::vector<std::string>& arguments) : roslaunch_(words(arguments)) {}
  /// A launch file of this package.
  Roslaunch(const std::string& file, std::vector<std::string> arguments)
      : Roslaunch(in_package(file, std::move(arguments))) {}
  ~Roslaunch() {
    if (!ended_) (void)end();
  }
  Roslaunch(const Roslaunch&) = delete;
  Roslaunch& operator=(const Roslaunch&) = delete;

  /// Ends it like Ctrl-C and returns its output.
  std::string end() {
    roslaunch_.signal(SIGINT);
    return wait();
  }
  /// Waits until it ends by itself and returns its output.
  std::string wait() {
    if (ended_) return output_;
    ended_ = true;
    output_ = roslaunch_.rest_of_out() + roslaunch_.rest_of_err();
    EXPECT_EQ(roslaunch_.wait(), 0) << output_;
    return output_;
  }

 private:
  static std::vector<std::string> words(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"/usr/bin/env", "roslaunch"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  static std::vector<std::string> in_package(const std::string& file, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"trk_bridge", file});
    return arguments;
  }

  Program roslaunch_;
  std::string output_;
  bool ended_ = false;
};

}  // namespace trk_bridge::test
