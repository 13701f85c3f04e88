// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A bag that is played in a loop: time jumps back with every repetition. ROS time is the bag's.
#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraParams.h>

#include "camera_display.h"
#include "program.h"
#include "published_camera.h"
#include "temporary_directory.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::test::bag_test {

// Half of it is enough time to see a place on a machine that draws slowly.
constexpr int rate = 50, seconds = 10;

/// What a camera's node publishes in `seconds` at one place, then at another.
void record(const std::string& path, const TrackedCamera& here, const TrackedCamera& there) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  for (int i = 0; i < rate * seconds; ++i) {
    const ::ros::Time stamp = ::ros::Time(1000) + ::ros::Duration(double(i) / rate);
    auto camera = i < rate * seconds / 2 ? here : there;
    camera.params.counter = static_cast<std::uint64_t>(i);
    tf2_msgs::TFMessage transforms;
    transforms.transforms.push_back(transform_of(camera, "recorded"));
    transforms.transforms.back().header.stamp = stamp;
    auto info = camera_info_of(camera);
    info.header.stamp = stamp;
    info.header.frame_id = "recorded_optical";
    trk_bridge::CameraParams params;
    params.header.stamp = stamp;
    ros1::to_msg(camera.params, params);
    bag.write("/tf", stamp, transforms);
    bag.write("/recorded/camera_info", stamp, info);
    bag.write("/recorded/params", stamp, params);
  }
}

TEST(Bag, IsDrawnInEveryLoop) {
  window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION);
  window().look({{0, 1.5, 1}, 10, -1.2, 0.4});
  const auto here = plain_camera(-1.5, 10), there = plain_camera(1.5, -20);
  const TemporaryDirectory directory;
  record(directory / "short.bag", here, there);
  auto& display = add_frustum("Camera", "/recorded/camera_info", "/recorded/params");
  const QColor green(0, 255, 0);
  property(display, {"Trail"}).setValue(true);
  property(display, {"Trail", "Color"}).setValue(green);
  property(display, {"Trail", "Length"}).setValue(60);
  property(display, {"Trail", "Line Width"}).setValue(0.03);
  EXPECT_TRUE(window().shows_status(display, "Camera Info", rviz::StatusProperty::Warn, "no messages received"));

  Program player(
      {"/usr/bin/env", "rosbag", "play", "--quiet", "--loop", "--clock", "--hz=100", directory / "short.bag"});
  for (int loop = 0; loop < 3; ++loop) {
    SCOPED_TRACE("loop " + std::to_string(loop));
    ASSERT_TRUE(becomes(here)) << statuses(display);
    EXPECT_TRUE(vanishes(green)) << "positions after the current time are not in the trail";
    const auto began = ::ros::Time::now();
    ASSERT_TRUE(becomes(there)) << statuses(display);
    EXPECT_TRUE(window().eventually([&] { return !window().picture().pixels(green).empty(); }))
        << "the trail between the two places";
    for (const char* line : {"Camera Info", "Camera Params", "Transform", "Lens", "Age"}) {
      EXPECT_TRUE(window().shows_status(display, line, rviz::StatusProperty::Ok)) << line;
    }
    EXPECT_GT(::ros::Time::now(), began);
    ASSERT_TRUE(window().eventually([&] { return ::ros::Time::now() < began; })) << "time has not jumped back";
  }
  player.signal(SIGINT);
  (void)player.rest_of_out();
  (void)player.rest_of_err();
  (void)player.wait();
  EXPECT_TRUE(window().draws()) << "time stands still";
}

}  // namespace trk_bridge::test::bag_test
