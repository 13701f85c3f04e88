// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Which lens is drawn, when it is recomputed, and why some cannot be drawn.
#include "rviz/lens_view.h"

#include <limits>

#include <gmock/gmock.h>

namespace trk_bridge::rviz_display::lens_view_test {

using testing::HasSubstr;

sensor_msgs::CameraInfo pinhole() {
  sensor_msgs::CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.K = {960, 0, 959.5, 0, 960, 539.5, 0, 0, 1};
  return info;
}

TEST(LensView, OfAPinholeHasItsAngles) {
  LensView view;
  EXPECT_EQ(view.border(), nullptr);
  EXPECT_TRUE(view.update(pinhole()));
  ASSERT_NE(view.border(), nullptr);
  EXPECT_NEAR(view.border()->horizontal, 90, 1e-9);
  EXPECT_EQ(view.focal_length(), 960);
  EXPECT_EQ(view.fault(), "");
  EXPECT_EQ(view.text(), "fx 960, fy 960, image 1920 x 1080");
}

TEST(LensView, ChangesOnlyWithTheLens) {
  LensView view;
  auto info = pinhole();
  EXPECT_TRUE(view.update(info));
  info.header.stamp = ros::Time(10);
  info.header.frame_id = "elsewhere";
  EXPECT_FALSE(view.update(info));
  info.K[0] = 961;
  EXPECT_TRUE(view.update(info));
  EXPECT_FALSE(view.update(info));
  view.forget();
  EXPECT_EQ(view.border(), nullptr);
  EXPECT_TRUE(view.update(info));
}

TEST(LensView, ThatIsInvalidGivesTheReasonAndDrawsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, nan, infinity, -1500.0, 1e-300, 1e300}) {
    for (const std::size_t which : {0u, 4u}) {
      LensView view;
      view.update(pinhole());
      auto info = pinhole();
      info.K[which] = bad;
      EXPECT_TRUE(view.update(info)) << bad;
      EXPECT_EQ(view.border(), nullptr) << bad;
      EXPECT_NE(view.fault(), "") << bad;
      EXPECT_EQ(view.text(), "");
      EXPECT_EQ(view.focal_length(), std::nullopt);
    }
  }
  LensView view;
  auto info = pinhole();
  info.K[0] = 0;
  view.update(info);
  EXPECT_THAT(view.fault(), HasSubstr("fx 0, fy 960"));
}

TEST(LensView, OfAnUnknownModelIsReported) {
  LensView view;
  auto info = pinhole();
  info.distortion_model = "equidistant";
  info.D = {0.1, 0, 0, 0};
  EXPECT_TRUE(view.update(info));
  EXPECT_EQ(view.border(), nullptr);
  EXPECT_THAT(view.fault(), HasSubstr("plumb_bob"));
  EXPECT_FALSE(view.update(info));
  info = pinhole();
  info.width = 0;
  EXPECT_TRUE(view.update(info));
  EXPECT_THAT(view.fault(), HasSubstr("width"));
  EXPECT_TRUE(view.update(pinhole()));
  EXPECT_EQ(view.fault(), "");
}

}  // namespace trk_bridge::rviz_display::lens_view_test
