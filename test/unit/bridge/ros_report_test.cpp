// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/ros_report.h"

#include <gmock/gmock.h>

namespace trk_bridge::bridge::ros_report_test {

using ::testing::HasSubstr;

constexpr std::int64_t second = 1'000'000'000;

class RosDiagnostics : public ::testing::Test {
 protected:
  RosDiagnostics() {
    now.master = MasterState::knows_node;
    now.master_uri = "http://studio:11311";
    now.ros_time = now.ros_time_moved = now.time = 100 * second;
    now.answered = 98 * second;
  }
  Status status() const {
    Status status;
    fill(status, findings(now, {}), now, {});
    return status;
  }
  void expect(Level level, const std::string& text) const {
    EXPECT_EQ(status().level, level);
    EXPECT_THAT(status().message, HasSubstr(text));
  }

  RosReport now;
};

TEST_F(RosDiagnostics, NoFindings) {
  expect(Level::ok, "the master knows this node; ROS time is the system's clock");
  now.is_simulated = true;
  expect(Level::ok, "the master knows this node; ROS time is /clock");
}

TEST_F(RosDiagnostics, AMasterThatIsSilentOrRestarted) {
  now.master = MasterState::silent;
  expect(Level::warn, "the master at http://studio:11311 does not answer");
  now.master = MasterState::forgot;
  expect(Level::warn, "the master does not know this node any more");
}

TEST_F(RosDiagnostics, SimulatedTimeThatStandsStill) {
  now.ros_time_moved = now.time - 3 * second;
  expect(Level::ok, "the system's clock");
  now.is_simulated = true;
  expect(Level::warn, "/clock stands or has been silent for 3.0 s");
  now.ros_time = 0;
  expect(Level::warn, "nothing is published on /clock");
  expect(Level::warn, "rosparam delete /use_sim_time");
  now.ros_time_moved = now.time - second;
  expect(Level::ok, "ROS time is /clock");
}

}  // namespace trk_bridge::bridge::ros_report_test
