// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "random_cameras.h"

namespace trk_bridge::camera::image_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

Lens lens_with(double k1, double k2) { return Lens{10, {0.3, -0.2}, k1, k2, 0, 0}; }

TEST(Projection, IsThatOfThePinhole) {
  const auto chip = project(Lens{20, {0.5, -0.25}}, Eigen::Vector3d(1, 4, -2));
  ASSERT_TRUE(chip);
  EXPECT_EQ(*chip, Eigen::Vector2d(4.5, -9.75));
}

TEST(Projection, ShowsOnlyPointsInFront) {
  for (const double depth : {0.0, -1.0, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    const auto chip = project(Lens{20}, Eigen::Vector3d(1, depth, 1));
    ASSERT_FALSE(chip);
    EXPECT_EQ(chip.error(), CameraReason::behind_camera);
  }
  const auto far = project(Lens{20}, Eigen::Vector3d(1, 5e-324, 1));
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error(), CameraReason::not_finite);
}

TEST(Raster, PutsCornersOfTheChipAtCornersOfThePicture) {
  // 700 x 570 of 720 x 576 pixels, 8 blank on the left and 2 below.
  const Raster raster = raster_of({0, 720, 576, 8, 12, 4, 2, 7, 5.7, 0, 0});
  EXPECT_NEAR(raster.mx, 100, 1e-12);
  EXPECT_NEAR(raster.my, 100, 1e-12);
  const Eigen::Vector2d lower_left = to_pixel(raster, {-3.5, -2.85});
  EXPECT_NEAR(lower_left.x(), 8 - 0.5, 1e-9);
  EXPECT_NEAR(lower_left.y(), 576 - 2 - 0.5, 1e-9);
  const Eigen::Vector2d upper_right = to_pixel(raster, {3.5, 2.85});
  EXPECT_NEAR(upper_right.x(), 720 - 12 - 0.5, 1e-9);
  EXPECT_NEAR(upper_right.y(), 4 - 0.5, 1e-9);
  EXPECT_LE((to_chip(raster, upper_right) - Eigen::Vector2d(3.5, 2.85)).norm(), 1e-12);
}

TEST(Raster, ReachesTheCornerFarthestFromTheAxis) {
  const Raster raster = raster_of({0, 1000, 500, 0, 0, 0, 0, 10, 5, 0, 0});
  EXPECT_NEAR(image_reach(Lens{10, {1, -0.5}}, raster), std::hypot(6, 3), 1e-12);
  EXPECT_NEAR(image_reach(Lens{10}, raster), std::hypot(5, 2.5), 1e-12);
  // Blanks are part of the image although they receive no light.
  const Raster blank = raster_of({0, 1200, 500, 200, 0, 0, 0, 10, 5, 0, 0});
  EXPECT_NEAR(image_reach(Lens{10}, blank), std::hypot(7, 2.5), 1e-12);
}

TEST(FieldOfView, IsTheAngleOfASideOfTheChip) {
  EXPECT_NEAR(field_of_view(4, 8).value(), 90, 1e-12);
  EXPECT_NEAR(field_of_view(4 * std::sqrt(3.0), 8).value(), 60, 1e-12);
  EXPECT_EQ(field_of_view(0, 8).error(), CameraReason::bad_field_of_view);
  EXPECT_EQ(field_of_view(4, 0).error(), CameraReason::bad_field_of_view);
  EXPECT_EQ(field_of_view(1e-300, 8).error(), CameraReason::bad_field_of_view);
  EXPECT_EQ(field_of_view(std::nan(""), 8).error(), CameraReason::not_finite);
  EXPECT_EQ(field_of_view(4, std::nan("")).error(), CameraReason::bad_field_of_view);
}

TEST(Distortion, FollowsThePolynomialOfTheDocument) {
  const Lens lens{10, {1, -1}, 0.01, 0.001, 0, 0};
  // (3, 4) from the axis: R = 25, u = 1 + 25 * (0.01 + 25 * 0.001) = 1.875.
  const Eigen::Vector2d undistorted = undistort(lens, {2, 5});
  EXPECT_NEAR(undistorted.x(), 3 * 1.875 - 1, 1e-14);
  EXPECT_NEAR(undistorted.y(), 4 * 1.875 + 1, 1e-14);
}

TEST(Distortion, IsInvertedToTheLastDigits) {
  test::RandomCameras random;
  for (int i = 0; i < 20000; ++i) {
    const Lens lens = lens_with(random.between(-3e-2, 3e-2), random.between(-1e-3, 1e-3));
    const double limit = std::min(monotonic_radius(lens), 50.0);
    const double angle = random.between(0, 2 * M_PI);
    const double radius = limit * random.between(0, 0.98);
    const Eigen::Vector2d seen = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)) - lens.center_shift;
    const auto found = distort(lens, undistort(lens, seen));
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_LE((*found - seen).norm(), 1e-13 * std::max(1.0, radius)) << "k1 " << lens.k1 << " k2 " << lens.k2;
  }
}

TEST(Distortion, IsInvertedUpToTheFoldAndRefusedBeyond) {
  // u(r) = r (1 - r^2 / 300): rises until r = 10, where it is 20/3.
  const Lens lens{10, {0, 0}, -1.0 / 300, 0, 0, 0};
  EXPECT_NEAR(monotonic_radius(lens), 10, 1e-12);
  const auto before = distort(lens, {20.0 / 3 - 1e-9, 0});
  ASSERT_TRUE(before);
  EXPECT_NEAR(before->x(), 10, 1e-3);
  EXPECT_LT(before->x(), 10);
  const auto beyond = distort(lens, {0, -20.0 / 3 - 1e-9});
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error(), CameraReason::not_monotonic);
}

TEST(Distortion, FindsTheFoldOfEveryPolynomial) {
  EXPECT_EQ(monotonic_radius(lens_with(0, 0)), infinity);
  EXPECT_EQ(monotonic_radius(lens_with(0.1, 0)), infinity);
  EXPECT_EQ(monotonic_radius(lens_with(0.1, 0.1)), infinity);
  EXPECT_NEAR(monotonic_radius(lens_with(0, -1.0 / 80)), 2, 1e-12);
  // 1 - 6 R + 5 R^2 is negative between R = 1/5 and 1; the fold is at the first.
  EXPECT_NEAR(monotonic_radius(lens_with(-2, 1)), std::sqrt(0.2), 1e-12);
  // 1 + 4 R - 5 R^2 is negative from R = 1 on.
  EXPECT_NEAR(monotonic_radius(lens_with(4.0 / 3, -1)), 1, 1e-12);
  // A point of inflection is no fold: 1 - 2 R + R^2.
  EXPECT_EQ(monotonic_radius(lens_with(-2.0 / 3, 0.2)), infinity);
  EXPECT_NEAR(monotonic_radius(lens_with(-1e308, 1e308)), std::sqrt(1.0 / 3) * 1e-154, 1e-165);
  EXPECT_NEAR(monotonic_radius(lens_with(-1e-300, 0)), std::sqrt(1 / 3e-300), 1e140);
}

TEST(Distortion, SurvivesAnyNumbers) {
  const double numbers[] = {0, -0.0, 1e-320, -1e-3, 1, -1e10, 1e200, -1.7e308, 1.7e308};
  for (const double k1 : numbers) {
    for (const double k2 : numbers) {
      for (const double x : numbers) {
        const auto found = distort(lens_with(k1, k2), {x, 1});
        if (found) {
          EXPECT_TRUE(found->allFinite()) << k1 << ' ' << k2 << ' ' << x;
        } else {
          EXPECT_TRUE(found.error() == CameraReason::not_monotonic || found.error() == CameraReason::not_finite);
        }
      }
    }
  }
  const auto nowhere = distort(lens_with(std::numeric_limits<double>::quiet_NaN(), 0), {1, 1});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error(), CameraReason::not_finite);
}

}  // namespace trk_bridge::camera::image_test
