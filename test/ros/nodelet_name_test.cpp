// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A nodelet waits for the one that had its name before.
#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "nodes/nodelet_name.h"

namespace trk_bridge::nodes::nodelet_name_test {

using std::chrono::milliseconds;

TEST(NodeletName, WaitsUntilTheNameIsFree) {
  auto before = std::make_unique<NodeletName>("/crane1/trk_to_ros");
  std::atomic<bool> is_loading = false, has_ended = false;
  std::thread loading([&] {
    is_loading = true;
    const NodeletName after("/crane1/trk_to_ros");
    EXPECT_TRUE(has_ended) << "two of one name";
  });
  while (!is_loading) std::this_thread::yield();
  has_ended = true;
  before.reset();
  loading.join();
}

TEST(NodeletName, OtherNamesDoNotWait) {
  const NodeletName one("/crane1/trk_to_ros");
  const NodeletName other("/crane2/trk_to_ros", milliseconds(0));
}

TEST(NodeletName, ANodeletThatNeverEndsIsAnError) {
  const NodeletName before("/crane1/trk_to_ros");
  EXPECT_THROW(NodeletName("/crane1/trk_to_ros", milliseconds(10)), std::runtime_error);
  const NodeletName other("/crane2/trk_to_ros", milliseconds(0));
}

}  // namespace trk_bridge::nodes::nodelet_name_test
