// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/rest_window.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace trk_bridge::monitor::rest_window_test {

constexpr std::int64_t field = 20'000'000;  // ns, 50 Hz

/// The deviation at rest after `seconds` of poses at 50 Hz; `pose_at` returns the pose of field n.
template <typename PoseAt>
Rest rest_after(double seconds, PoseAt pose_at) {
  RestWindow window;
  const int fields = static_cast<int>(std::lround(seconds * 50));
  for (int n = 0; n <= fields; ++n) window.add(n * field, pose_at(n));
  return window.classify();
}

TEST(RestWindow, KnowsNothingAtFirst) {
  EXPECT_EQ(RestWindow().classify().motion, Motion::unknown);
  EXPECT_EQ(rest_after(2.6, [](int) { return PoseNumbers{}; }).motion, Motion::unknown);
  EXPECT_EQ(rest_after(2.7, [](int) { return PoseNumbers{}; }).motion, Motion::still);
}

TEST(RestWindow, TooFewPosesGiveNoResult) {
  RestWindow window;
  for (int n = 0; n < 19; ++n) window.add(n * 160'000'000LL, {});
  EXPECT_EQ(window.classify().motion, Motion::unknown);
}

TEST(RestWindow, DeviationIsThatOfTheSample) {
  // A millimetre up and down: of 151 poses in the window, 76 of one and 75 of the other.
  const auto rest = rest_after(3.0, [](int n) { return PoseNumbers{1.5 + (n % 2) * 0.001, 2, 3, 4, 5, 6}; });
  ASSERT_EQ(rest.motion, Motion::still);
  EXPECT_NEAR(rest.deviation[0], 0.001 * std::sqrt(76.0 * 75.0 / (151.0 * 150.0)), 1e-12);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(rest.deviation[i], 0) << i;
}

TEST(RestWindow, NoiseIsNotMotion) {
  std::mt19937 random(1);
  std::normal_distribution<double> mm(0, 0.0005), degrees(0, 0.01);
  const auto rest = rest_after(4.0, [&](int) {
    return PoseNumbers{mm(random), mm(random), mm(random), degrees(random), degrees(random), degrees(random)};
  });
  ASSERT_EQ(rest.motion, Motion::still);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(rest.deviation[i], 0.0005, 0.0001) << i;
  for (std::size_t i = 3; i < 6; ++i) EXPECT_NEAR(rest.deviation[i], 0.01, 0.002) << i;
}

TEST(RestWindow, ASlowMoveIsMotionAlthoughItsRangeIsSmall) {
  // One millimetre per second: 3 mm in the window, less than the noise that is accepted.
  EXPECT_EQ(rest_after(4.0, [](int n) { return PoseNumbers{n * 0.00002, 0, 0, 0, 0, 0}; }).motion, Motion::moving);
  // 0.02 degrees per second.
  EXPECT_EQ(rest_after(4.0, [](int n) { return PoseNumbers{0, 0, 0, n * 0.0004, 0, 0}; }).motion, Motion::moving);
}

TEST(RestWindow, AWideSwingIsMotionAlthoughItReturns) {
  const auto rest = rest_after(4.0, [](int n) { return PoseNumbers{0, 0, 0, 0, 0.5 * std::sin(n * 0.5), 0}; });
  EXPECT_EQ(rest.motion, Motion::moving);
}

TEST(RestWindow, AnglesUseTheSmallestDifference) {
  const auto rest = rest_after(3.0, [](int n) { return PoseNumbers{0, 0, 0, n % 2 == 0 ? 179.99 : -179.99, 0, 0}; });
  ASSERT_EQ(rest.motion, Motion::still);
  EXPECT_NEAR(rest.deviation[3], 0.02 * std::sqrt(76.0 * 75.0 / (151.0 * 150.0)), 1e-9);
}

TEST(RestWindow, IsAtRestThreeSecondsAfterAMove) {
  const auto pose = [](int n) { return PoseNumbers{n < 100 ? n * 0.01 : 1.0, 0, 0, 0, 0, 0}; };
  EXPECT_EQ(rest_after(4.0, pose).motion, Motion::moving);
  EXPECT_EQ(rest_after(5.1, pose).motion, Motion::still);
}

TEST(RestWindow, RestartsWhenTheClockIsSetBack) {
  RestWindow window;
  for (int n = 0; n <= 150; ++n) window.add(n * field, {});
  window.add(0, {});
  EXPECT_EQ(window.classify().motion, Motion::unknown);
}

}  // namespace trk_bridge::monitor::rest_window_test
