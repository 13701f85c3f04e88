// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_messages.h"

#include <gmock/gmock.h>

namespace trk_bridge::ros1::camera_messages_test {

constexpr std::int64_t today = 1'700'000'000'123'456'789;

bridge::CameraUpdate whole(std::int64_t stamp) {
  bridge::CameraUpdate update;
  update.stamp = stamp;
  update.constants = wire::CameraConstants{3, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39};
  update.params.emplace();
  update.params->counter = 7;
  update.calibration.emplace();
  update.calibration->width = 1920;
  update.pose = Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3));
  return update;
}

TEST(CameraMessages, OneStampForEverythingOfASampleInItsFrames) {
  CameraMessages messages({"studio", "crane1", "crane1_optical"});
  messages.make(whole(today));
  const ::ros::Time expected(1'700'000'000, 123'456'789);
  EXPECT_EQ(messages.params()->header.stamp, expected);
  EXPECT_EQ(messages.constants()->header.stamp, expected);
  EXPECT_EQ(messages.camera_info()->header.stamp, expected);
  EXPECT_EQ(messages.transform().header.stamp, expected);
  EXPECT_EQ(messages.params()->header.frame_id, "studio");
  EXPECT_EQ(messages.constants()->header.frame_id, "crane1");
  EXPECT_EQ(messages.camera_info()->header.frame_id, "crane1_optical");
  EXPECT_EQ(messages.transform().header.frame_id, "studio");
  EXPECT_EQ(messages.transform().child_frame_id, "crane1");
  EXPECT_EQ(messages.params()->counter, 7u);
  EXPECT_EQ(messages.constants()->id, 3u);
  EXPECT_EQ(messages.camera_info()->width, 1920u);
  EXPECT_EQ(messages.transform().transform.translation.z, 3);
}

TEST(CameraMessages, EncodersSayWhichOfThemAreKnown) {
  CameraMessages messages({"studio", "crane1", "crane1_optical"});
  auto update = whole(today);
  update.encoders = bridge::CameraEncoders{5, {74565, -3, {}}};
  messages.make(update);
  const auto& message = *messages.lens_encoders();
  EXPECT_EQ(message.header.stamp, ::ros::Time(1'700'000'000, 123'456'789));
  EXPECT_EQ(message.header.frame_id, "studio");
  EXPECT_EQ(message.id, 5u);
  EXPECT_TRUE(message.zoom_known && message.focus_known);
  EXPECT_EQ(message.zoom, 74565);
  EXPECT_EQ(message.focus, -3);
  EXPECT_FALSE(message.iris_known);
  EXPECT_EQ(message.iris, 0);
}

TEST(CameraMessages, MessagesThatAreNotInAnUpdateStay) {
  CameraMessages messages({"studio", "crane1", "crane1_optical"});
  messages.make(whole(today));
  bridge::CameraUpdate pose;
  pose.stamp = today + 1;
  pose.pose = Eigen::Isometry3d::Identity();
  messages.make(pose);
  EXPECT_EQ(messages.transform().header.stamp, ::ros::Time(1'700'000'000, 123'456'790));
  EXPECT_EQ(messages.params()->header.stamp, ::ros::Time(1'700'000'000, 123'456'789));
  EXPECT_EQ(messages.camera_info()->width, 1920u);
  EXPECT_EQ(messages.constants()->id, 3u);
}

TEST(CameraMessages, ConstantsOfUnknownTimeHaveStampZero) {
  CameraMessages messages({"studio", "crane1", "crane1_optical"});
  messages.make(whole(0));
  EXPECT_TRUE(messages.constants()->header.stamp.isZero());
}

}  // namespace trk_bridge::ros1::camera_messages_test
