// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The texts about a camera.
#include "rviz/texts.h"

#include <gmock/gmock.h>

namespace trk_bridge::rviz_display::texts_test {

using testing::HasSubstr;

TEST(Values, AreTwoLines) {
  Values values;
  EXPECT_EQ(text_of(values), "");
  values.pan_tilt_roll = camera::PanTiltRoll{-12.346, 4.5, -0.001};
  EXPECT_EQ(text_of(values), "pan -12.35\u00b0   tilt 4.50\u00b0   roll 0.00\u00b0");
  values.focal_length = 1500.4;
  values.field_of_view = Values::Angles{65.23, 39.6};
  values.counter = 18446744073709551615u;
  EXPECT_EQ(text_of(values),
            "pan -12.35\u00b0   tilt 4.50\u00b0   roll 0.00\u00b0\n"
            "f 1500 px   fov 65.2\u00b0 x 39.6\u00b0   #18446744073709551615");
}

TEST(Values, ShowMillimetresIfTheyAreKnown) {
  Values values;
  values.focal_length = 1500;
  values.image_distance = 7.5;
  EXPECT_EQ(text_of(values), "f 7.50 mm");
}

TEST(Values, OfAnySizeFit) {
  Values values;
  values.pan_tilt_roll = camera::PanTiltRoll{1e300, -1e300, 1e300};
  values.image_distance = 1e308;
  EXPECT_THAT(text_of(values), HasSubstr("f 1"));
}

TEST(NameOfTopic, IsItsNamespace) {
  EXPECT_EQ(name_of_topic("/returned/camera_info"), "returned");
  EXPECT_EQ(name_of_topic("/studio/left/camera_info"), "studio/left");
  EXPECT_EQ(name_of_topic("left/camera_info"), "left");
  EXPECT_EQ(name_of_topic("/camera_info"), "camera_info");
  EXPECT_EQ(name_of_topic("camera_info"), "camera_info");
  EXPECT_EQ(name_of_topic("/"), "");
  EXPECT_EQ(name_of_topic(""), "");
}

TEST(Age, IsThatOfTheStamp) {
  const ros::Time now(1000), arrived(999.5);
  const auto fresh = age_of(ros::Time(999.98), arrived, now);
  EXPECT_TRUE(fresh.fresh);
  EXPECT_EQ(fresh.text, "0.02 s");
  const auto old = age_of(ros::Time(998.5), arrived, now);
  EXPECT_FALSE(old.fresh);
  EXPECT_THAT(old.text, HasSubstr("1.50 s"));
  EXPECT_TRUE(age_of(ros::Time(1000.5), arrived, now).fresh);
  const auto future = age_of(ros::Time(1002), arrived, now);
  EXPECT_FALSE(future.fresh);
  EXPECT_THAT(future.text, HasSubstr("future"));
}

TEST(Age, WithoutAStampIsThatOfTheArrival) {
  EXPECT_TRUE(age_of(ros::Time(), ros::Time(999.5), ros::Time(1000)).fresh);
  const auto old = age_of(ros::Time(), ros::Time(990), ros::Time(1000));
  EXPECT_FALSE(old.fresh);
  EXPECT_THAT(old.text, HasSubstr("10.00 s"));
}

TEST(Silence, NamesTopicAndStart) {
  EXPECT_EQ(silence_text("/a/camera_info", ros::Time(990.25), ros::Time(1000)),
            "no messages on /a/camera_info for 9.8 s, since 990.250");
}

}  // namespace trk_bridge::rviz_display::texts_test
