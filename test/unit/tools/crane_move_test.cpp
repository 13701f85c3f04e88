#include "crane_move.h"

#include <cmath>

#include <gtest/gtest.h>

#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::tools {
namespace {

constexpr double field = 0.02;       // s
constexpr int ten_minutes = 30'000;  // fields

TEST(CraneMove, TheArmKeepsItsLengthAndClearsTheFloor) {
  for (int i = 0; i < ten_minutes; ++i) {
    const Eigen::Vector3d position = crane_camera(i * field).pose.translation();
    EXPECT_NEAR((position - Eigen::Vector3d(0, 0, 1.5)).norm(), 10.0, 1e-12);
    ASSERT_GT(position.z(), 0.5);
    ASSERT_LE(std::abs(std::atan2(position.x(), position.y())) * 180 / M_PI, 35.0 + 1e-9);
  }
}

TEST(CraneMove, TheTargetStaysInTheMiddleAndTheHorizonLevel) {
  for (int i = 0; i < ten_minutes; ++i) {
    const camera::Camera crane = crane_camera(i * field);
    const Eigen::Vector3d seen = crane.pose.inverse() * Eigen::Vector3d(0, 18, 1.5);
    EXPECT_NEAR(seen.x(), 0, 1e-9);
    EXPECT_NEAR(seen.z(), 0, 1e-9);
    EXPECT_NEAR(seen.y(), crane.lens.focdist, 1e-9);
    ASSERT_GT(seen.y(), 0);
    EXPECT_NEAR(crane.pose.linear()(2, 0), 0, 1e-12) << "the camera's right stays level";
  }
}

TEST(CraneMove, EverythingIsSmooth) {
  // A jump in position, direction or lens would show as an acceleration that no crane has.
  for (int i = 1; i < ten_minutes; ++i) {
    const auto before = crane_camera((i - 1) * field), now = crane_camera(i * field),
               after = crane_camera((i + 1) * field);
    const auto second = [](auto a, auto b, auto c) { return (a - 2 * b + c) / (field * field); };
    const Eigen::Vector3d acceleration =
        second(before.pose.translation(), now.pose.translation(), after.pose.translation());
    const Eigen::Vector3d turn =
        second(before.pose.linear().col(1).eval(), now.pose.linear().col(1).eval(), after.pose.linear().col(1).eval());
    ASSERT_LT(acceleration.norm(), 2.0) << "m/s^2 at field " << i;
    ASSERT_LT(turn.norm(), 0.5) << "rad/s^2 at field " << i;
    ASSERT_LT(std::abs(second(before.lens.image_distance, now.lens.image_distance, after.lens.image_distance)), 20.0);
    ASSERT_LT(std::abs(second(before.lens.k1, now.lens.k1, after.lens.k1)), 1e-3);
    ASSERT_LT(std::abs(second(before.lens.focdist, now.lens.focdist, after.lens.focdist)), 2.0);
  }
}

TEST(CraneMove, TheLensGoesFromWideToLongAndNeverFoldsThePicture) {
  const wire::CameraConstants constants = crane_constants();
  ASSERT_TRUE(camera::check(constants));
  double least = 1e9, most = 0, least_k1 = 1, most_k1 = -1;
  for (int i = 0; i < ten_minutes; ++i) {
    const camera::Lens lens = crane_camera(i * field).lens;
    least = std::min(least, lens.image_distance);
    most = std::max(most, lens.image_distance);
    least_k1 = std::min(least_k1, lens.k1);
    most_k1 = std::max(most_k1, lens.k1);
    // Half the chip's diagonal, and what the optical axis wanders.
    ASSERT_GT(camera::monotonic_radius(lens), 5.6);
  }
  EXPECT_NEAR(least, 8.0, 1e-2);
  EXPECT_NEAR(most, 80.0, 1e-1);
  EXPECT_LE(least, most);
  EXPECT_GT(most_k1, 0) << "barrel when wide";
  EXPECT_LT(least_k1, 0) << "cushion when long";
}

}  // namespace
}  // namespace trk_bridge::tools
