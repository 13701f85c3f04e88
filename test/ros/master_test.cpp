// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A ROS master that ends and starts again: nodes keep their connections, and report that they cannot be found by
// others.
#include <cstdio>
#include <cstdlib>

#include <trk_bridge/CameraParams.h>

#include "node_process.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "test_limit.h"

namespace trk_bridge::test::master_test {

using diagnostic_msgs::DiagnosticStatus;

std::string master_port;

/// roscore, as a user starts it.
class Roscore {
 public:
  Roscore() : program_({"/usr/bin/env", "roscore", "-p", master_port}) {
    while (const auto line = program_.out_line()) {
      if (line->find("started core service") != std::string::npos) return;
    }
    throw std::runtime_error("no roscore: " + program_.rest_of_err());
  }
  ~Roscore() {
    program_.signal(SIGINT);
    (void)program_.rest_of_out();
    (void)program_.rest_of_err();
    (void)program_.wait();
  }
  Roscore(const Roscore&) = delete;
  Roscore& operator=(const Roscore&) = delete;

 private:
  Program program_;
};

std::optional<Roscore> roscore;

/// The node as a process.
class Master : public NodeProcessTest {
 protected:
  Master() : NodeProcessTest(TRK_TO_ROS), params(name_space + "/params") { set("source", any_udp_port); }

  std::string ros() const { return status_name("ROS"); }
  ::testing::AssertionResult goes_on() {
    const auto before = params.messages.size();
    if (!tracker) tracker.emplace(port());
    if (eventually([&] {
          tracker->send(test::params(++counter));
          return params.messages.size() > before + 10;
        })) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "no more params are received";
  }

  Recorder<trk_bridge::CameraParams> params;
  std::optional<Tracker> tracker;
  std::uint64_t counter = 0;
};

TEST_F(Master, ARestartIsReportedByNodesAndNodeletsThatContinue) {
  ASSERT_TRUE(starts());
  // In the process of the test, like in a nodelet manager.
  ::ros::param::set(name_space + "/other/source", any_udp_port);
  ::ros::param::set(name_space + "/other/diagnostic_period", 0.1);
  const nodes::TrkToRos other(::ros::NodeHandle(name_space + "_other", {{"/diagnostics", diagnostics.topic()}}),
                              ::ros::NodeHandle(name_space + "/other"), name_space + "/other");
  const std::string ros_of_other = name_space.substr(1) + "/other: ROS";
  const auto both_report = [&](int level, const char* text) {
    EXPECT_TRUE(diagnostics.reports(ros(), level, text));
    EXPECT_TRUE(diagnostics.reports(ros_of_other, level, text));
  };
  both_report(DiagnosticStatus::OK, "the master knows this node");
  EXPECT_TRUE(goes_on());

  roscore.reset();
  both_report(DiagnosticStatus::WARN, "does not answer: existing connections stay");
  EXPECT_TRUE(goes_on());

  roscore.emplace();
  both_report(DiagnosticStatus::WARN, "the master does not know this node any more");
  EXPECT_TRUE(goes_on());
  ::ros::NodeHandle().advertise<trk_bridge::CameraParams>("late", 1);
  EXPECT_TRUE(diagnostics.reports(ros_of_other, DiagnosticStatus::WARN, "does not know")) << "the rest is still lost";

  node->signal(SIGINT);
  const auto output = node->rest_of_err();
  EXPECT_EQ(node->wait(), 0);
  EXPECT_THAT(output, ::testing::HasSubstr("does not answer"));
  EXPECT_THAT(output, ::testing::HasSubstr("the master does not know this node any more"));
}

}  // namespace trk_bridge::test::master_test

int main(int argc, char** argv) {
  using namespace trk_bridge::test;
  using namespace trk_bridge::test::master_test;
  ::testing::InitGoogleMock(&argc, argv);
  limit_each_test();
  const TemporaryDirectory logs;
  const ReservedPort reserved;
  master_port = reserved.text();
  ::setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + master_port).c_str(), /*overwrite=*/1);
  ::setenv("ROS_LOG_DIR", logs.path().c_str(), /*overwrite=*/1);
  ::setenv("ROS_IP", "127.0.0.1", /*overwrite=*/1);
  ::setenv("PYTHONUNBUFFERED", "1", /*overwrite=*/1);
  roscore.emplace();
  ::ros::init(argc, argv, "test");
  int status = 1;
  {
    const ::ros::NodeHandle keeps_ros_running;
    status = RUN_ALL_TESTS();
  }
  roscore.reset();
  return status;
}
