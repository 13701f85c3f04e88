// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The past positions of a camera.
#include "rviz/trail.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace trk_bridge::rviz_display::trail_test {

Eigen::Vector3d along(double x) { return {x, 0, 0}; }

TEST(Trail, IsAsLongAsWanted) {
  Trail trail;
  for (int i = 0; i <= 100; ++i) trail.add(ros::Time(100 + 0.1 * i), "camera", along(i), 5);
  ASSERT_EQ(trail.points().size(), 51u);
  EXPECT_EQ(trail.points().front().position.x(), 50);
  EXPECT_EQ(trail.points().back().position.x(), 100);
  trail.add(ros::Time(110.1), "camera", along(101), 1);
  EXPECT_EQ(trail.points().size(), 11u);
  trail.add(ros::Time(110.2), "camera", along(102), 0);
  EXPECT_EQ(trail.points().size(), 1u);
}

TEST(Trail, LinesJoinTheNeighbours) {
  Trail trail;
  EXPECT_TRUE(lines_of(trail).empty());
  trail.add(ros::Time(1), "camera", along(0), 5);
  EXPECT_TRUE(lines_of(trail).empty());
  trail.add(ros::Time(2), "camera", along(1), 5);
  trail.add(ros::Time(3), "camera", along(2), 5);
  EXPECT_THAT(lines_of(trail), testing::ElementsAre(along(0), along(1), along(1), along(2)));
}

TEST(Trail, OfACameraAtRestDoesNotGrowAndEndsAtTheCamera) {
  Trail trail;
  for (int i = 0; i < 1000; ++i) trail.add(ros::Time(100 + 0.001 * i), "camera", along(i * 1e-7), 5);
  EXPECT_LE(trail.points().size(), 3u);
  EXPECT_EQ(trail.points().back().position.x(), 999 * 1e-7);
  EXPECT_EQ(trail.points().back().time, ros::Time(100.999));
  for (int i = 0; i < 1000; ++i) trail.add(ros::Time(200 + 0.01 * i), "camera", along(i * 1e-4), 5);
  EXPECT_NEAR(static_cast<double>(trail.points().size()), 0.05 / Trail::spacing, 5) << "slow ones are thinned out";
}

TEST(Trail, IsBounded) {
  Trail trail;
  for (int i = 0; i < 10000; ++i) trail.add(ros::Time(100 + 0.001 * i), "camera", along(i), 600);
  EXPECT_EQ(trail.points().size(), Trail::most);
  EXPECT_EQ(trail.points().back().position.x(), 9999);
}

TEST(Trail, IgnoresOlderTimesAndPositionsThatAreNotFinite) {
  Trail trail;
  trail.add(ros::Time(10), "camera", along(0), 5);
  trail.add(ros::Time(11), "camera", along(1), 5);
  trail.add(ros::Time(11), "camera", along(2), 5);
  trail.add(ros::Time(10.5), "camera", along(3), 5);
  trail.add(ros::Time(12), "camera", along(std::nan("")), 5);
  trail.add(ros::Time(13), "camera", along(std::numeric_limits<double>::infinity()), 5);
  ASSERT_EQ(trail.points().size(), 2u);
  EXPECT_EQ(trail.points().back().position.x(), 1);
}

TEST(Trail, StartsAgainForAnotherFrame) {
  Trail trail;
  trail.add(ros::Time(10), "one", along(0), 5);
  trail.add(ros::Time(11), "one", along(1), 5);
  trail.add(ros::Time(12), "other", along(2), 5);
  EXPECT_EQ(trail.points().size(), 1u);
}

TEST(Trail, MovesToAnotherFixedFrameWhereItIsKnown) {
  Trail trail;
  for (int i = 0; i < 4; ++i) trail.add(ros::Time(10 + i), "camera", along(i), 60);
  trail.move([](const std::string& frame, const ros::Time& time) -> std::optional<Eigen::Vector3d> {
    EXPECT_EQ(frame, "camera");
    if (time < ros::Time(11.5)) return std::nullopt;
    return Eigen::Vector3d(0, time.toSec(), 0);
  });
  ASSERT_EQ(trail.points().size(), 2u);
  EXPECT_EQ(trail.points().front().position, Eigen::Vector3d(0, 12, 0));
  EXPECT_EQ(trail.points().back().position, Eigen::Vector3d(0, 13, 0));
}

}  // namespace trk_bridge::rviz_display::trail_test
