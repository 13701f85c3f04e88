// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Clocks that are wrong, are set or stand still: what ros_to_trk sends from tf then, and what every node reports.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <trk_bridge/CameraParams.h>

#include "node_process.h"
#include "nodes/ros_to_trk.h"
#include "receiver.h"
#include "repeating.h"

namespace trk_bridge::test::clocks_test {

using diagnostic_msgs::DiagnosticStatus;
using std::chrono::duration;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

/// The longest interruption when a clock is set: 1 s, and the pauses of a busy machine.
constexpr duration<double> most_pause{2.5};

geometry_msgs::TransformStamped link(const std::string& parent, const std::string& child, double stamp, double x) {
  geometry_msgs::TransformStamped t;
  t.header.stamp.fromSec(stamp);
  t.header.frame_id = parent;
  t.child_frame_id = child;
  t.transform.translation.x = x;
  t.transform.rotation.w = 1;
  return t;
}

double now() { return ::ros::Time::now().toSec(); }

/// A crane on tf: studio -> rail (static), rail -> arm -> camera, at 50 Hz by the crane's clock.
class CraneOnTf : public NodeTest<nodes::RosToTrk> {
 protected:
  CraneOnTf() : NodeTest("ros_to_trk") {
    set("sinks", receiver.url());
    set("input", "tf");
    set("chip_width", 9.6);
    set("chip_height", 5.4);
    statics.sendTransform(link("studio", camera + "_rail", now(), 0));
    infos = ::ros::NodeHandle().advertise<sensor_msgs::CameraInfo>(name_space + "/camera_info", 1, /*latch=*/true);
    sensor_msgs::CameraInfo m;
    m.header.stamp.fromSec(now());
    m.width = 1920;
    m.height = 1080;
    m.distortion_model = "plumb_bob";
    m.D = {0, 0, 0, 0, 0};
    m.K = {2000, 0, 959.5, 0, 2000, 539.5, 0, 0, 1};
    infos.publish(m);
  }
  void send(double stamp, double x) {
    broadcaster.sendTransform(
        {link(camera + "_rail", camera + "_arm", stamp, 0), link(camera + "_arm", camera, stamp, x)});
  }
  /// Starts moving by the clock of the crane.
  void move(std::function<double()> crane_clock) {
    moving.reset();
    moving.emplace(50, [this, crane_clock = std::move(crane_clock)] { send(crane_clock(), ++at); });
  }
  /// The same, off by this.
  void move(double offset) {
    move([offset] { return now() + offset; });
  }
  /// Whether poses are sent for `time`, and after it, without a pause longer than `most_pause`.
  ::testing::AssertionResult goes_on(duration<double> time = duration<double>(1.5)) {
    const auto begin = Clock::now();
    auto last = begin;
    duration<double> longest{0};
    auto count = receiver.params.size();
    (void)eventually([&] {
      receiver.take();
      longest = std::max<duration<double>>(longest, Clock::now() - last);
      if (receiver.params.size() > count) last = Clock::now();
      count = receiver.params.size();
      return longest > most_pause || last - begin > time;
    });
    std::printf("longest pause: %.0f ms\n", longest.count() * 1000);
    if (longest <= most_pause) return ::testing::AssertionSuccess();
    const auto* status = diagnostics.find(status_name());
    return ::testing::AssertionFailure() << "nothing was received for " << longest.count() << " s, the node reports "
                                         << (status == nullptr ? "nothing" : status->message);
  }
  /// That no pose was received twice, out of order or from another sender.
  void expect_true_poses() {
    ASSERT_FALSE(receiver.params.empty());
    for (std::size_t i = 1; i < receiver.params.size(); ++i) {
      ASSERT_GT(receiver.params[i].euler.x, receiver.params[i - 1].euler.x);
      ASSERT_EQ(receiver.params[i].counter, receiver.params[i - 1].counter + 1);
    }
    EXPECT_LE(receiver.params.back().euler.x, at);
  }
  ::testing::AssertionResult last_restart_has(const std::string& text) {
    const auto shown = [&] { return diagnostics.value(status_name(), "last tf restart"); };
    if (eventually([&] { return shown().find(text) != std::string::npos; })) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << shown() << ", not " << text;
  }

  Receiver receiver;
  tf2_ros::StaticTransformBroadcaster statics;
  tf2_ros::TransformBroadcaster broadcaster;
  ::ros::Publisher infos;
  std::atomic<int> at{0};
  std::optional<Repeating> moving;
};

TEST_F(CraneOnTf, OneTransformFarAheadIsIgnored) {
  move(0);
  ASSERT_TRUE(starts());
  ASSERT_TRUE(goes_on());
  for (const char* end : {"", "_arm"}) {
    broadcaster.sendTransform(link(camera + (*end == '\0' ? "_arm" : "_rail"), camera + end, now() + 1e6, -1));
    EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN,
                                    "transforms refused: the stamps of frame " + camera + end + " from /test"));
    EXPECT_TRUE(goes_on());
  }
  EXPECT_TRUE(diagnostics.becomes(status_name(), "transforms refused", "2"));
  EXPECT_EQ(diagnostics.value(status_name(), "tf restarts"), "0");
  expect_true_poses();
}

TEST_F(CraneOnTf, AClockThatIsSetBackAndForthIsFollowed) {
  move(0);
  ASSERT_TRUE(starts());
  ASSERT_TRUE(goes_on());
  int restarts = 0;
  for (const double offset : {-60.0, 0.0, 3600.0, -1e6, 5.0, 0.0}) {
    move(offset);
    ASSERT_TRUE(goes_on(duration<double>(2))) << offset;
    // A jump from a minute ago to now does not stop tf.
    if (offset != 0 || restarts != 1) ++restarts;
    EXPECT_TRUE(diagnostics.becomes(status_name(), "tf restarts", std::to_string(restarts))) << offset;
    EXPECT_NEAR(std::stod(diagnostics.value(status_name(), "tf ahead of ROS time (s)")), offset, 2);
  }
  expect_true_poses();
}

TEST_F(CraneOnTf, AClockThatIsAnHourAheadFromTheStartIsFollowedAndShown) {
  move(3600);
  ASSERT_TRUE(starts());
  ASSERT_TRUE(goes_on());
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "ahead of ROS time: check the clocks"));
  EXPECT_NEAR(std::stod(diagnostics.value(status_name(), "tf ahead of ROS time (s)")), 3600, 2);
  expect_true_poses();
}

TEST_F(CraneOnTf, ABagThatLoopsWithoutSimulatedTimeIsFollowedAtEveryLoop) {
  const auto begin = Clock::now();
  move([begin] { return 1.5e9 + std::fmod(duration<double>(Clock::now() - begin).count(), 3); });
  ASSERT_TRUE(starts());
  ASSERT_TRUE(goes_on(duration<double>(10)));
  EXPECT_TRUE(last_restart_has("went back by "));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, " s behind ROS time"));
  expect_true_poses();
}

/// ROS time of this process comes from the test.
class SimulatedTime : public CraneOnTf {
 protected:
  static constexpr double start = 1.5e9;  // s

  SimulatedTime() { ::ros::Time::setNow(::ros::Time(start)); }
  ~SimulatedTime() override {
    moving.reset();
    ::ros::Time::init();
  }

  /// A bag of 3 s that plays in a loop, with its clock.
  void play() {
    move([begin = Clock::now()] {
      const auto time = ::ros::Time(start + std::fmod(duration<double>(Clock::now() - begin).count(), 3));
      ::ros::Time::setNow(time);
      return time.toSec();
    });
  }
  std::string ros() const { return status_name("ROS"); }
};

TEST_F(SimulatedTime, ABagThatLoopsIsFollowedAtOnce) {
  play();
  ASSERT_TRUE(starts());
  ASSERT_TRUE(goes_on(duration<double>(10)));
  EXPECT_TRUE(last_restart_has("ROS time went back by "));
  EXPECT_EQ(diagnostics.value(status_name(), "transforms refused"), "0");
  EXPECT_TRUE(diagnostics.reports(ros(), DiagnosticStatus::OK, "the master knows this node; ROS time is /clock"));
  expect_true_poses();
}

TEST_F(SimulatedTime, ThatStandsStillIsShownUntilItRuns) {
  ASSERT_TRUE(starts());
  EXPECT_TRUE(diagnostics.reports(ros(), DiagnosticStatus::WARN, "/clock stands or has been silent for "));
  play();
  EXPECT_TRUE(diagnostics.reports(ros(), DiagnosticStatus::OK, "ROS time is /clock"));
}

/// Nodes as processes, which ask for /use_sim_time when they start. Nobody publishes /clock.
class SilentClock : public NodeProcessTest, public ::testing::WithParamInterface<const char*> {
 protected:
  SilentClock() : NodeProcessTest(GetParam()) {
    ::ros::param::set("/use_sim_time", true);
    if (program_path == TRK_TO_ROS) set("source", any_udp_port);
    if (program_path == ROS_TO_TRK) set("sinks", receiver.url());
  }
  ~SilentClock() override { ::ros::param::del("/use_sim_time"); }

  const Receiver receiver;
};

TEST_P(SilentClock, IsAWarningInTheDiagnosticsAndTheLogOfEveryNode) {
  start();
  const char* const reason = "use_sim_time is set, but nothing is published on /clock";
  EXPECT_TRUE(diagnostics.reports(status_name("ROS"), DiagnosticStatus::WARN, reason));
  node->signal(SIGINT);
  EXPECT_THAT(node->rest_of_err(), AllOf(HasSubstr(reason), HasSubstr("rosparam delete /use_sim_time")));
  EXPECT_EQ(node->wait(), 0);
}

INSTANTIATE_TEST_SUITE_P(Of, SilentClock, ::testing::Values(TRK_TO_ROS, ROS_TO_TRK, CRANE_SHOT, TEST_CARD),
                         [](const auto& test) {
                           const std::string path = test.param;
                           return path.substr(path.find_last_of('/') + 1);
                         });

}  // namespace trk_bridge::test::clocks_test
