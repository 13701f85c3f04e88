// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// ros_to_trk with `input: tf`: tf and CameraInfo as input; what is sent over UDP, and when.
#include <algorithm>
#include <chrono>
#include <thread>

#include <sensor_msgs/CameraInfo.h>
#include <tf2_ros/transform_broadcaster.h>
#include <trk_bridge/CameraParams.h>

#include "fixture.h"
#include "receiver.h"

namespace trk_bridge::test::outgoing_tf_test {

using diagnostic_msgs::DiagnosticStatus;

class FromTf : public RosToTrkTest {
 protected:
  void open(double rate = 100) {
    set_sinks({receiver.url()});
    set("input", "tf");
    set("rate", rate);
    set("chip_width", 9.6);
    set("chip_height", 5.4);
    set("aperture", 2.8);
    info_publisher = ::ros::NodeHandle().advertise<sensor_msgs::CameraInfo>(name_space + "/camera_info", 10);
    lens_publisher = ::ros::NodeHandle().advertise<trk_bridge::CameraParams>(name_space + "/lens", 10);
    ASSERT_TRUE(starts());
  }

  sensor_msgs::CameraInfo info() const {
    sensor_msgs::CameraInfo m;
    m.header.stamp = ::ros::Time::now();
    m.width = 1920;
    m.height = 1080;
    m.distortion_model = "plumb_bob";
    m.D = {0, 0, 0, 0, 0};
    m.K = {2000, 0, 959.5, 0, 2000, 539.5, 0, 0, 1};
    return m;
  }

  void broadcast(const std::string& child, double x) {
    geometry_msgs::TransformStamped m;
    m.header.stamp = ::ros::Time::now();
    m.header.frame_id = "studio";
    m.child_frame_id = child;
    m.transform.translation.x = x;
    m.transform.rotation.w = 1;
    broadcaster.sendTransform(m);
  }

  /// Moves the camera until this many sets have been received.
  bool moves(std::size_t sets) {
    return eventually([&] {
      broadcast(camera, ++at);
      receiver.take();
      return receiver.params.size() >= sets;
    });
  }

  ::ros::Publisher info_publisher, lens_publisher;
  tf2_ros::TransformBroadcaster broadcaster;
  Receiver receiver;
  double at = 0;
};

TEST_F(FromTf, NothingIsSentWithoutTfOrALensAndTheReasonIsReported) {
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::STALE, "nothing sent yet: tf: "));
  EXPECT_TRUE(eventually([&] {
    broadcast(camera, 1);
    const auto* status = diagnostics.find(status_name());
    return status->message.find("no camera_info yet on " + name_space + "/camera_info") != std::string::npos;
  }));
  auto fisheye = info();
  fisheye.distortion_model = "equidistant";
  info_publisher.publish(fisheye);
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::STALE,
                                  "camera_info is refused: distortion_model must be plumb_bob or rational_polynomial"));
  receiver.take();
  EXPECT_TRUE(receiver.params.empty());
  info_publisher.publish(info());
  EXPECT_TRUE(moves(1));
  EXPECT_EQ(receiver.params.front().counter, 1u);
}

TEST_F(FromTf, StaleTfIsNeverSentAgain) {
  ASSERT_NO_FATAL_FAILURE(open());
  info_publisher.publish(info());
  ASSERT_TRUE(moves(20));
  ASSERT_TRUE(eventually([&] {
    receiver.take();
    return receiver.params.back().euler.x == at;
  })) << "the last pose was sent";
  const auto sets = receiver.params.size();
  EXPECT_TRUE(diagnostics.becomes(status_name(), "sets", std::to_string(sets)));
  EXPECT_TRUE(diagnostics.reports(status_name(), DiagnosticStatus::WARN, "tf is stale, its newest pose is of "));
  receiver.take();
  EXPECT_EQ(receiver.params.size(), sets);
  for (std::size_t i = 0; i < sets; ++i) {
    EXPECT_EQ(receiver.params[i].counter, i + 1);
    const double before = i == 0 ? 0 : receiver.params[i - 1].euler.x;
    EXPECT_GT(receiver.params[i].euler.x, before) << "every set has a different pose";
  }
  ASSERT_TRUE(moves(sets + 5));
  EXPECT_EQ(receiver.params[sets].counter, sets + 1) << "the counter continues";
  EXPECT_TRUE(eventually([&] {
    broadcast(camera, ++at);
    return diagnostics.find(status_name())->level == DiagnosticStatus::OK;
  }));
}

TEST_F(FromTf, PoseLensConstantsAndFocusAreSent) {
  set("id", 7);
  ASSERT_NO_FATAL_FAILURE(open());
  info_publisher.publish(info());
  trk_bridge::CameraParams lens;
  lens.focdist = 4.5;
  lens.aperture = 5.6;
  lens_publisher.publish(lens);
  ASSERT_TRUE(eventually([&] {
    broadcast(camera, 3);
    receiver.take();
    return !receiver.params.empty() && receiver.params.back().focdist == 4.5;
  }));
  const auto& p = receiver.params.back();
  EXPECT_EQ(p.id, 7u);
  EXPECT_EQ(p.euler.x, 3);
  EXPECT_NEAR(p.fov, 10, 1e-12);
  EXPECT_EQ(p.aperture, 5.6);
  ASSERT_FALSE(receiver.constants.empty());
  EXPECT_EQ(receiver.constants.front(), (wire::CameraConstants{7, 1920, 1080, 0, 0, 0, 0, 9.6, 5.4, 9.6, 5.4}));
}

TEST_F(FromTf, SetsAreNotFasterThanTheRate) {
  constexpr double rate = 20;
  ASSERT_NO_FATAL_FAILURE(open(rate));
  info_publisher.publish(info());
  ASSERT_TRUE(moves(1));
  const auto begin = std::chrono::steady_clock::now();
  receiver.take();
  const auto before = receiver.params.size();
  constexpr int sets = 40;
  ASSERT_TRUE(moves(before + sets));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  // At the start one may be late and the next one in time.
  EXPECT_GT(took.count(), (sets - 2) / rate);
}

/// x is the time of the pose in s, modulo 1000.
class FromTfInTime : public FromTf {
 protected:
  static double x_of(const ::ros::Time& time) { return time.sec % 1000 + time.nsec / 1e9; }

  /// At 50 Hz, as exactly as the machine allows, until the condition is met.
  bool moves_until(const std::function<bool()>& met) {
    auto next = std::chrono::steady_clock::now();
    return eventually([&] {
      if (std::chrono::steady_clock::now() >= next) {
        next += std::chrono::milliseconds(20);
        broadcast(camera, x_of(::ros::Time::now()));
      }
      receiver.take();
      return met();
    });
  }
  double least_age() const { return *std::min_element(ages.begin(), ages.end()); }

  /// The age of each set when it is received, in s.
  std::vector<double> ages;
  ::ros::Subscriber sent = ::ros::NodeHandle().subscribe<trk_bridge::CameraParams>(
      name_space + "/sent", 1000, [this](const trk_bridge::CameraParamsConstPtr& message) {
        ages.push_back((::ros::Time::now() - message->header.stamp).toSec());
        messages.push_back(*message);
      });
  std::vector<trk_bridge::CameraParams> messages;
};

TEST_F(FromTfInTime, ADelayIsExactAccordingToTheStampsOfTf) {
  set("delay", 0.05);
  ASSERT_NO_FATAL_FAILURE(open(50));
  info_publisher.publish(info());
  ASSERT_TRUE(moves_until([&] { return receiver.params.size() >= 60 && messages.size() >= 60; }));
  EXPECT_GE(least_age(), 0.05);
  EXPECT_LT(least_age(), 0.06);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(receiver.params[i].counter, i + 1);
    const auto& message = messages[i];
    EXPECT_EQ(message.counter, i + 1);
    EXPECT_NEAR(message.x, x_of(message.header.stamp), 1e-4) << "between two poses it is interpolated";
    EXPECT_NEAR(receiver.params[i].euler.x, message.x, 1e-6) << "/sent is equal to what is sent";
  }
  EXPECT_TRUE(diagnostics.becomes(status_name(receiver.url()), "delay (s)", "0.05"));
  EXPECT_GE(std::stod(diagnostics.value(status_name(receiver.url()), "age of what is sent (ms)")), 50);
}

/// Departures with a random phase to tf would have least ages anywhere up to 20 ms, different after each start.
/// Departures keep a margin to poses that arrive with jitter, as on a busy machine.
TEST_F(FromTfInTime, TheAgeIsTheSameAfterEveryStart) {
  for (const int phase : {0, 5, 10, 15}) {
    node.reset();
    std::this_thread::sleep_for(std::chrono::milliseconds(phase));
    ASSERT_NO_FATAL_FAILURE(open(50));
    info_publisher.publish(info());
    ages.clear();
    ASSERT_TRUE(moves_until([&] { return ages.size() >= 100; }));
    EXPECT_LT(least_age(), 0.008) << "started " << phase << " ms later";
  }
}

TEST_F(FromTfInTime, AtTheRateOfTfEveryPoseIsSentOnArrival) {
  set("rate", std::string("tf"));
  set_sinks({receiver.url()});
  set("input", "tf");
  set("chip_width", 9.6);
  set("chip_height", 5.4);
  info_publisher = ::ros::NodeHandle().advertise<sensor_msgs::CameraInfo>(name_space + "/camera_info", 10);
  ASSERT_TRUE(starts());
  ASSERT_TRUE(eventually([&] { return info_publisher.getNumSubscribers() > 0; }));
  info_publisher.publish(info());
  ASSERT_TRUE(moves(1));
  for (int i = 0; i < 50; ++i) {
    broadcast(camera, ++at);
    ASSERT_TRUE(eventually([&] {
      receiver.take();
      return receiver.params.back().euler.x == at;
    })) << i;
  }
}

}  // namespace trk_bridge::test::outgoing_tf_test
