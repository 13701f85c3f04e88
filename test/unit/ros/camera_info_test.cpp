// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Which fields of a CameraInfo message belong to its lens.
#include "ros/camera_info.h"

#include <gmock/gmock.h>

namespace trk_bridge::ros1::camera_info_test {

sensor_msgs::CameraInfo some_message() {
  sensor_msgs::CameraInfo message;
  message.width = 1920;
  message.height = 1080;
  message.distortion_model = "plumb_bob";
  message.D = {1, 2, 3, 4, 5};
  message.K = {1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1};
  return message;
}

TEST(CameraInfoMessage, FieldByField) {
  const auto info = from_msg(some_message());
  EXPECT_EQ(info.width, 1920u);
  EXPECT_EQ(info.height, 1080u);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_THAT(info.d, ::testing::ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(info.k, ::testing::ElementsAre(1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1));
}

TEST(CameraInfoMessage, RefersToTheFullImageWhateverPartIsSent) {
  auto part = some_message();
  part.binning_x = part.binning_y = 2;
  part.roi.x_offset = 100;
  part.roi.width = part.roi.height = 50;
  part.P = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  part.R = {0, 1, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(bridge::same_calibration(from_msg(part), from_msg(some_message())));
}

TEST(CameraInfoMessage, ReplacesTheOneBefore) {
  bridge::CameraInfo info = from_msg(some_message());
  auto other = some_message();
  other.distortion_model = "rational_polynomial";
  other.D = {1, 2, 3, 4, 5, 6, 7, 8};
  from_msg(other, info);
  EXPECT_TRUE(bridge::same_calibration(info, from_msg(other)));
}

}  // namespace trk_bridge::ros1::camera_info_test
