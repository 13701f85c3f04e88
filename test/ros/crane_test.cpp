// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The crane's path out and back, as in launch/crane.launch: joints, tf, trk over UDP, tf.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <trk_bridge/CameraParams.h>

#include "fixture.h"
#include "reserved_port.h"
#include "roslaunch.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::test::crane_test {

constexpr double metres = 1e-4;        // largest difference between the crane and what is received back
constexpr double degrees = 1e-3;       // likewise
constexpr double pixels = 1e-3;        // likewise, of every element of K
const ::ros::Duration long_enough(5);  // of moving samples
constexpr std::size_t enough = 120;    // samples

double degrees_between(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return Eigen::Quaterniond(one.linear()).angularDistance(Eigen::Quaterniond(other.linear())) * 180 / M_PI;
}

bool agree(const sensor_msgs::CameraInfo& one, const sensor_msgs::CameraInfo& other) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= pixels; };
  return one.width == other.width && one.height == other.height &&
         std::equal(one.K.begin(), one.K.end(), other.K.begin(), near);
}

class CraneRoundTrip : public ::testing::TestWithParam<const char*> {
 protected:
  CraneRoundTrip()
      : sent_("/crane/sent"),
        returned_("/returned/params"),
        crane_info_("/crane/camera_info"),
        returned_info_("/returned/camera_info"),
        listener_(transforms_),
        launched_("crane.launch", {"rviz:=false", "endpoint:=" + port_.url(), std::string("preset:=") + GetParam()}) {}

  /// Everything that is compared has been received once: the nodes are connected.
  bool has_received_all() const {
    return !sent_.messages.empty() && !returned_.messages.empty() && !crane_info_.messages.empty() &&
           !returned_info_.messages.empty() && transforms_.canTransform("studio", "camera_optical", ::ros::Time()) &&
           transforms_.canTransform("studio", "returned_optical", ::ros::Time());
  }

  /// Both cameras have moved long enough, and enough samples were received meanwhile.
  bool moved() const {
    const auto spans = [](const auto& messages) {
      return messages.size() > 2 * enough && messages.back().header.stamp - messages.front().header.stamp > long_enough;
    };
    return spans(sent_.messages) && spans(returned_.messages);
  }

  /// Everything except the crane's CameraInfos, because an earlier one may be the newest when a set is sent.
  void forget() {
    sent_.messages.clear();
    returned_.messages.clear();
    returned_info_.messages.clear();
  }

  /// Times of the crane by counter. The first second is left out: topics that are on time may be that far apart.
  std::map<std::uint64_t, ::ros::Time> crane_times() const {
    std::map<std::uint64_t, ::ros::Time> times;
    for (const auto& message : sent_.messages) {
      const ::ros::Time& time = message.header.stamp;
      if (time - sent_.messages.front().header.stamp > ::ros::Duration(1)) times[message.counter] = time;
    }
    return times;
  }

  /// Of a frame in the studio; none if tf does not contain it.
  std::optional<Eigen::Isometry3d> pose(const std::string& frame, const ::ros::Time& stamp) {
    if (!eventually([&] { return transforms_.canTransform("studio", frame, stamp); })) return std::nullopt;
    return ros1::to_isometry(transforms_.lookupTransform("studio", frame, stamp).transform);
  }

  /// By how much the crane's CameraInfo that was received back with a pose is older than the pose; none if it is
  /// another one.
  std::optional<::ros::Duration> lag_of_lens(const ::ros::Time& of_crane, const ::ros::Time& of_returned) {
    const auto& infos = returned_info_.messages;
    const auto earlier = [](const auto& info, const ::ros::Time& time) { return info.header.stamp < time; };
    auto returned = infos.end();
    const auto arrived = [&] {
      returned = std::lower_bound(infos.begin(), infos.end(), of_returned, earlier);
      return returned != infos.end() && !crane_info_.messages.empty() &&
             crane_info_.messages.back().header.stamp >= of_crane;
    };
    if (!eventually(arrived) || returned->header.stamp != of_returned) return std::nullopt;
    for (auto crane = crane_info_.messages.rbegin(); crane != crane_info_.messages.rend(); ++crane) {
      if (crane->header.stamp <= of_crane && agree(*crane, *returned)) return of_crane - crane->header.stamp;
    }
    return std::nullopt;
  }

  struct Compared {
    std::size_t sets = 0, with_their_lens = 0;
    std::size_t late_lenses = 0;  ///< of a CameraInfo that is older than 0.1 s
    Eigen::AlignedBox3d covered;

    /// On a busy machine a CameraInfo may be late, and the pose is sent with the previous one, but not for ever.
    bool lenses_are_on_time() const { return late_lenses == 0 && with_their_lens >= sets * 9 / 10; }
  };

  void compare(Compared& compared) {
    const auto times = crane_times();
    for (const auto& message : std::vector(returned_.messages)) {
      const auto found = times.find(message.counter);
      if (found == times.end()) continue;
      SCOPED_TRACE("counter " + std::to_string(message.counter));
      for (const std::string axes : {"", "_optical"}) {
        const auto crane = pose("camera" + axes, found->second);
        const auto returned = pose("returned" + axes, message.header.stamp);
        ASSERT_TRUE(crane && returned);
        ASSERT_LE((crane->translation() - returned->translation()).norm(), metres);
        ASSERT_LE(degrees_between(*crane, *returned), degrees);
        compared.covered.extend(crane->translation());
      }
      const auto lag = lag_of_lens(found->second, message.header.stamp);
      ASSERT_TRUE(lag) << "no CameraInfo of the crane has this K";
      if (lag->toSec() >= 0.1) ++compared.late_lenses;
      if (lag->isZero()) ++compared.with_their_lens;
      ++compared.sets;
    }
  }

  Recorder<trk_bridge::CameraParams> sent_, returned_;
  Recorder<sensor_msgs::CameraInfo> crane_info_, returned_info_;
  tf2_ros::Buffer transforms_{::ros::Duration(60)};
  tf2_ros::TransformListener listener_;
  const ReservedPort port_;
  Roslaunch launched_;
};

TEST_P(CraneRoundTrip, BothCamerasCoincide) {
  ASSERT_TRUE(eventually([this] { return has_received_all(); })) << launched_.end();
  const auto end = std::chrono::steady_clock::now() + deadline;
  Compared compared;
  do {
    forget();
    ASSERT_TRUE(eventually([this] { return moved(); })) << launched_.end();
    compared = Compared();
    ASSERT_NO_FATAL_FAILURE(compare(compared));
    EXPECT_GE(compared.sets, enough);
    EXPECT_GT(compared.covered.diagonal().norm(), 0.5) << "m that the camera moved meanwhile";
  } while (!compared.lenses_are_on_time() && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(compared.late_lenses, 0u);
  EXPECT_GE(compared.with_their_lens, compared.sets * 9 / 10);
}

TEST(Crane, UsesJointStatesOfAnotherNode) {
  const auto publisher = ::ros::NodeHandle().advertise<sensor_msgs::JointState>("/joint_states", 100);
  Recorder<sensor_msgs::JointState> joint_states("/joint_states");
  Recorder<trk_bridge::CameraParams> returned("/returned/params");
  const ReservedPort port;
  Roslaunch launched("crane.launch", {"rviz:=false", "endpoint:=" + port.url(), "joints:=external"});
  sensor_msgs::JointState all_zero;
  all_zero.name = {"column_pan", "arm_elevation", "arm_extension", "head_pan", "head_tilt", "head_roll"};
  all_zero.position.assign(all_zero.name.size(), 0.0);
  ASSERT_TRUE(eventually([&] {
    all_zero.header.stamp = ::ros::Time::now();
    publisher.publish(all_zero);
    return returned.messages.size() > 20;
  })) << launched.end();
  // The arm is level and retracted; the camera hangs below its end and looks along it.
  const auto& camera = returned.messages.back();
  EXPECT_NEAR(camera.x, -2, 1e-9);
  EXPECT_NEAR(camera.y, -3 + 5 + 0.12, 1e-9);
  EXPECT_NEAR(camera.z, 1.5 - 0.36 - 0.34, 1e-9);
  EXPECT_NEAR(camera.pan, 0, 1e-9);
  EXPECT_NEAR(camera.tilt, 0, 1e-9);
  EXPECT_NEAR(camera.roll, 0, 1e-9);
  for (const auto& message : joint_states.messages) EXPECT_EQ(message.position, all_zero.position);
}

INSTANTIATE_TEST_SUITE_P(Presets, CraneRoundTrip, ::testing::Values("pixotope", "orad"));

}  // namespace trk_bridge::test::crane_test
