// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "node_process.h"

#include <csignal>
#include <vector>

namespace trk_bridge::test {

NodeProcessTest::NodeProcessTest(const std::string& of_program)
    : CameraTest(of_program.substr(of_program.find_last_of('/') + 1)), program_path(of_program) {}

void NodeProcessTest::start() {
  auto words = launcher;
  for (const auto& word : {program_path, "__ns:=" + name_space, "/diagnostics:=" + diagnostics.topic()}) {
    words.push_back(word);
  }
  node = std::make_unique<Program>(words);
}

::testing::AssertionResult NodeProcessTest::starts() {
  start();
  auto reported = reports_on(camera);
  if (!reported) {
    node->signal(SIGKILL);
    reported << "; output: " << node->rest_of_err();
  }
  return reported;
}

std::string NodeProcessTest::refusal() {
  start();
  const std::string output = node->rest_of_err();
  EXPECT_EQ(node->wait(), 1);
  return output;
}

std::chrono::nanoseconds NodeProcessTest::interrupted() {
  const auto begin = std::chrono::steady_clock::now();
  node->signal(SIGINT);
  (void)node->rest_of_err();
  EXPECT_EQ(node->wait(), 0);
  return std::chrono::steady_clock::now() - begin;
}

}  // namespace trk_bridge::test
