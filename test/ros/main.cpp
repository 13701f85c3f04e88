// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Arguments: [FILE...]. Runs the tests of these source files, as a node with a separate ROS master.
#include <cstdio>
#include <cstdlib>

#include <gmock/gmock.h>
#include <ros/ros.h>

#include "program.h"
#include "selected_files.h"
#include "temporary_directory.h"
#include "test_limit.h"

int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  if (!trk_bridge::test::select_files({argv + 1, argv + argc})) return 2;
  trk_bridge::test::limit_each_test();
  trk_bridge::test::Program master({PYTHON, "-B", MASTER});
  const auto uri = master.out_line();
  if (!uri) {
    std::fprintf(stderr, "no ROS master: %s\n", master.rest_of_err().c_str());
    return 1;
  }
  const trk_bridge::test::TemporaryDirectory logs;
  ::setenv("ROS_MASTER_URI", uri->c_str(), /*overwrite=*/1);
  ::setenv("ROS_LOG_DIR", logs.path().c_str(), /*overwrite=*/1);
  // The default is an address that every machine has.
  if (std::getenv("ROS_HOSTNAME") == nullptr) ::setenv("ROS_IP", "127.0.0.1", /*overwrite=*/0);
  ::ros::init(argc, argv, "test");
  const ::ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
