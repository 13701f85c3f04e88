// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Turns, from rotations and from points that a lens shows.
#include "delay/turn.h"

#include <random>

#include <gmock/gmock.h>

namespace trk_bridge::delay::turn_test {

constexpr double degree = M_PI / 180;

camera::Raster raster() {
  wire::CameraConstants constants;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.chip_width = 9.6;
  constants.chip_height = 5.4;
  return camera::raster_of(constants);
}

camera::Lens lens() {
  camera::Lens lens;
  lens.image_distance = 8;
  lens.center_shift = {0.1, -0.05};
  lens.k1 = 1.5e-3;
  return lens;
}

/// Points all over the picture, seen by two cameras.
std::vector<MovedPoint> seen(const Eigen::Matrix3d& before, const camera::Lens& lens_before, const Eigen::Matrix3d& now,
                             const camera::Lens& lens_now) {
  std::vector<MovedPoint> points;
  for (double x = -0.5; x < 0.51; x += 0.1) {
    for (double z = -0.25; z < 0.26; z += 0.1) {
      const Eigen::Vector3d place = before * Eigen::Vector3d(10 * x, 10, 10 * z);
      const auto pixel = [&](const Eigen::Matrix3d& rotation, const camera::Lens& through) {
        const Eigen::Vector3d before_camera = rotation.transpose() * place;
        return camera::to_pixel(raster(),
                                camera::distort(through, camera::project(through, before_camera).value()).value());
      };
      points.push_back({pixel(before, lens_before), pixel(now, lens_now)});
    }
  }
  return points;
}

void expect_near(const Turn& turn, const Turn& expected, double tolerance) {
  EXPECT_LT((turn - expected).norm(), tolerance) << turn.transpose() << " for " << expected.transpose();
}

TEST(TurnBetween, HasTheSignsOfTheProtocol) {
  const Eigen::Matrix3d level = camera::rotation_of({30, 0, 0});
  expect_near(turn_between(level, camera::rotation_of({31, 0, 0})), Turn(1, 0, 0) * degree, 1e-12);
  expect_near(turn_between(level, camera::rotation_of({30, 1, 0})), Turn(0, 1, 0) * degree, 1e-12);
  expect_near(turn_between(level, camera::rotation_of({30, 0, 1})), Turn(0, 0, 1) * degree, 1e-12);
  expect_near(turn_between(level, level), Turn::Zero(), 1e-12);
}

TEST(TurnOf, IsWhatTheCameraTurned) {
  const Eigen::Matrix3d before = camera::rotation_of({20, -5, 3});
  for (const auto& angles : {camera::PanTiltRoll{22.4, -5, 3}, {20, -3.5, 3}, {20, -5, 1}, {18.5, -6, 4}}) {
    const Eigen::Matrix3d now = camera::rotation_of(angles);
    const auto turn = turn_of(seen(before, lens(), now, lens()), lens(), raster());
    ASSERT_TRUE(turn);
    expect_near(*turn, turn_between(before, now), 1e-3 * turn_between(before, now).norm());
  }
}

TEST(TurnOf, ZoomIsNotATurn) {
  const Eigen::Matrix3d rotation = camera::rotation_of({0, 0, 0});
  auto longer = lens();
  longer.image_distance *= 1.01;
  const auto turn = turn_of(seen(rotation, lens(), rotation, longer), longer, raster());
  ASSERT_TRUE(turn);
  expect_near(*turn, Turn::Zero(), 2e-4);
}

TEST(TurnOf, FollowsTheMajorityOfPoints) {
  const Eigen::Matrix3d before = camera::rotation_of({0, 0, 0}), now = camera::rotation_of({1, 0.5, 0});
  auto points = seen(before, lens(), now, lens());
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.2);  // pixels
  for (auto& point : points) point.now += Eigen::Vector2d(noise(random), noise(random));
  // A third of them, all by the same amount.
  for (std::size_t i = 0; i < points.size() / 3; ++i) points[i].now = points[i].before + Eigen::Vector2d(-25, 3);
  const auto turn = turn_of(points, lens(), raster());
  ASSERT_TRUE(turn);
  expect_near(*turn, turn_between(before, now), 3e-4);
}

TEST(TurnOf, IsNoneIfPointsDoNotAgree) {
  const Eigen::Matrix3d rotation = camera::rotation_of({0, 0, 0});
  auto points = seen(rotation, lens(), rotation, lens());
  points.resize(7);
  EXPECT_FALSE(turn_of(points, lens(), raster())) << "too few";
  EXPECT_FALSE(turn_of({}, lens(), raster()));
}

}  // namespace trk_bridge::delay::turn_test
