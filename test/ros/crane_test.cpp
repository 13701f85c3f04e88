// The crane's way out and back, as launch/crane.launch makes it: joints, tf, trk over UDP, tf.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <optional>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <trk_bridge/CameraParams.h>

#include "fixture.h"
#include "trk_bridge/ros/frames.h"

namespace trk_bridge::test {
namespace {

constexpr double metres = 1e-4;        // may lie between what the crane did and what came back
constexpr double degrees = 1e-3;       // so may these
constexpr double pixels = 1e-3;        // and these of every element of K
const ::ros::Duration long_enough(4);  // of moving samples
constexpr std::size_t enough = 150;    // samples
constexpr std::chrono::seconds patience{60};

/// roslaunch and all its nodes, ended with the test.
class Launched {
 public:
  explicit Launched(std::vector<std::string> words) : roslaunch_(std::move(words)) {}
  ~Launched() { (void)end(); }
  Launched(const Launched&) = delete;
  Launched& operator=(const Launched&) = delete;

  /// What it said, once it has ended.
  std::string end() {
    if (ended_) return said_;
    ended_ = true;
    roslaunch_.signal(SIGINT);
    said_ = roslaunch_.rest_of_out() + roslaunch_.rest_of_err();
    EXPECT_EQ(roslaunch_.wait(), 0) << said_;
    return said_;
  }

 private:
  Program roslaunch_;
  std::string said_;
  bool ended_ = false;
};

double degrees_between(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  return Eigen::Quaterniond(one.linear()).angularDistance(Eigen::Quaterniond(other.linear())) * 180 / M_PI;
}

/// Null when none of this stamp was recorded.
const sensor_msgs::CameraInfo* info_of(const Recorder<sensor_msgs::CameraInfo>& recorder, const ::ros::Time& stamp) {
  const auto found =
      std::lower_bound(recorder.messages.begin(), recorder.messages.end(), stamp,
                       [](const auto& info, const ::ros::Time& time) { return info.header.stamp < time; });
  return found != recorder.messages.end() && found->header.stamp == stamp ? &*found : nullptr;
}

class CraneThereAndBack : public ::testing::TestWithParam<const char*> {
 protected:
  CraneThereAndBack()
      : sent_("/crane/sent"),
        returned_("/returned/params"),
        crane_info_("/crane/camera_info"),
        returned_info_("/returned/camera_info"),
        listener_(transforms_),
        launched_({"/usr/bin/env", "roslaunch", "trk_bridge", "crane.launch", "rviz:=false",
                   "endpoint:=" + udp_url(free_udp_port()), std::string("preset:=") + GetParam()}) {}

  /// Both cameras have moved long enough, and were told often enough meanwhile.
  bool moved() const {
    const auto spans = [](const auto& messages) {
      return messages.size() > enough && messages.back().header.stamp - messages.front().header.stamp > long_enough;
    };
    return spans(sent_.messages) && spans(returned_.messages);
  }

  /// Of a frame in the studio; none when tf does not tell it.
  std::optional<Eigen::Isometry3d> pose(const std::string& frame, const ::ros::Time& stamp) {
    if (!eventually([&] { return transforms_.canTransform("studio", frame, stamp); })) return std::nullopt;
    return ros1::to_isometry(transforms_.lookupTransform("studio", frame, stamp).transform);
  }

  void expect_same_lens(const ::ros::Time& of_crane, const ::ros::Time& of_returned) {
    const sensor_msgs::CameraInfo *crane = nullptr, *returned = nullptr;
    ASSERT_TRUE(eventually([&] {
      crane = info_of(crane_info_, of_crane);
      returned = info_of(returned_info_, of_returned);
      return crane != nullptr && returned != nullptr;
    }));
    ASSERT_EQ(crane->width, returned->width);
    ASSERT_EQ(crane->height, returned->height);
    for (std::size_t i = 0; i < crane->K.size(); ++i) ASSERT_NEAR(crane->K[i], returned->K[i], pixels) << "K " << i;
  }

  Recorder<trk_bridge::CameraParams> sent_, returned_;
  Recorder<sensor_msgs::CameraInfo> crane_info_, returned_info_;
  tf2_ros::Buffer transforms_{::ros::Duration(60)};
  tf2_ros::TransformListener listener_;
  Launched launched_;
};

TEST_P(CraneThereAndBack, BothCamerasCoincide) {
  ASSERT_TRUE(eventually([this] { return moved(); }, patience)) << launched_.end();
  std::map<std::uint64_t, ::ros::Time> crane_time;
  for (const auto& message : sent_.messages) crane_time[message.counter] = message.header.stamp;

  std::size_t compared = 0;
  Eigen::AlignedBox3d covered;
  for (const auto& message : returned_.messages) {
    const auto found = crane_time.find(message.counter);
    if (found == crane_time.end()) continue;  // sent before this test listened
    SCOPED_TRACE("counter " + std::to_string(message.counter));
    for (const std::string axes : {"", "_optical"}) {
      const auto crane = pose("camera" + axes, found->second), returned = pose("returned" + axes, message.header.stamp);
      ASSERT_TRUE(crane && returned);
      ASSERT_LE((crane->translation() - returned->translation()).norm(), metres);
      ASSERT_LE(degrees_between(*crane, *returned), degrees);
      covered.extend(crane->translation());
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_lens(found->second, message.header.stamp));
    ++compared;
  }
  EXPECT_GE(compared, enough - 10) << "but for the few before both topics were heard";
  EXPECT_GT(covered.diagonal().norm(), 0.5) << "m that the camera moved meanwhile";
}

INSTANTIATE_TEST_SUITE_P(Presets, CraneThereAndBack, ::testing::Values("pixotope", "orad"));

}  // namespace
}  // namespace trk_bridge::test
