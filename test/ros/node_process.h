// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A node as a separate process, for tests of its start and end.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "fixture.h"
#include "program.h"

namespace trk_bridge::test {

class NodeProcessTest : public CameraTest {
 protected:
  /// The node has the name of its program.
  explicit NodeProcessTest(const std::string& of_program);

  void start();
  /// Starts it and waits until it has reported the state of its camera.
  ::testing::AssertionResult starts();
  /// Expects it to end with 1 at once and returns its output.
  std::string refusal();
  /// Ends it like Ctrl-C; returns how long that took.
  std::chrono::nanoseconds interrupted();

  std::string program_path;
  std::vector<std::string> launcher;  ///< words before the program's, where it is to be run by another one
  std::unique_ptr<Program> node;
};

}  // namespace trk_bridge::test
