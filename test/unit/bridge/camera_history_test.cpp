// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/camera_history.h"

#include <memory>

#include <gtest/gtest.h>

namespace trk_bridge::bridge::camera_history_test {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t start = 1'700'000'000'000 * ms;

/// x in m, focal length in mm.
camera::Camera camera_at(double x, double focal_length = 10) {
  camera::Camera camera;
  camera.pose.translation().x() = x;
  camera.lens.image_distance = focal_length;
  return camera;
}

class CameraHistoryTest : public ::testing::Test {
 protected:
  void add(std::int64_t time, double x) { history->add(camera_at(x), start + time, start + time); }
  double x_at(std::int64_t time, std::int64_t lead = 0) const {
    const std::int64_t at = start + time;
    const auto found = history->at({at, at, at}, lead);
    return found ? found->camera.pose.translation().x() : -1;
  }

  const std::unique_ptr<CameraHistory> history = std::make_unique<CameraHistory>();
};

TEST_F(CameraHistoryTest, BetweenSamplesItIsInterpolatedByTheirTimes) {
  add(0, 0);
  add(20 * ms, 1);
  add(60 * ms, 5);
  EXPECT_EQ(x_at(0), 0);
  EXPECT_NEAR(x_at(5 * ms), 0.25, 1e-12);
  EXPECT_EQ(x_at(20 * ms), 1);
  EXPECT_NEAR(x_at(30 * ms), 2, 1e-12);
}

TEST_F(CameraHistoryTest, BeforeTheFirstSampleNothingIsKnown) {
  EXPECT_EQ(x_at(0), -1);
  add(20 * ms, 1);
  EXPECT_EQ(x_at(20 * ms - 1), -1);
  EXPECT_EQ(x_at(20 * ms), 1);
}

TEST_F(CameraHistoryTest, WithoutLeadItStaysAtTheNewest) {
  add(0, 0);
  add(20 * ms, 1);
  EXPECT_EQ(x_at(20 * ms + 1), 1);
  EXPECT_EQ(x_at(1000 * ms), 1);
}

TEST_F(CameraHistoryTest, LeadExtrapolatesAndStops) {
  add(0, 0);
  add(20 * ms, 1);
  EXPECT_NEAR(x_at(30 * ms, 40 * ms), 1.5, 1e-12);
  EXPECT_NEAR(x_at(60 * ms, 40 * ms), 3, 1e-12);
  EXPECT_NEAR(x_at(61 * ms, 40 * ms), 3, 1e-12);
  EXPECT_NEAR(x_at(900 * ms, 40 * ms), 3, 1e-12);
  EXPECT_NEAR(x_at(900 * ms, 10 * ms), 1.5, 1e-12);
}

/// With two times 1 us apart, a millimetre of noise would become a speed of 1000 m/s.
TEST_F(CameraHistoryTest, LeadDoesNotAmplifyTheNoiseOfCloseTimes) {
  add(0, 0);
  add(20 * ms, 1);
  add(20 * ms + 1000, 1.001);
  EXPECT_NEAR(x_at(40 * ms, 40 * ms), 2, 0.01);
}

TEST_F(CameraHistoryTest, OneSampleIsNotExtrapolated) {
  add(0, 7);
  EXPECT_EQ(x_at(30 * ms, 40 * ms), 7);
}

TEST_F(CameraHistoryTest, ALateSampleIsInsertedInOrder) {
  add(0, 0);
  add(40 * ms, 2);
  EXPECT_NEAR(x_at(30 * ms), 1.5, 1e-12);
  add(20 * ms, 1.9);
  add(20 * ms, 77);
  EXPECT_EQ(history->newest(), start + 40 * ms);
  EXPECT_NEAR(x_at(10 * ms), 0.95, 1e-12);
  EXPECT_NEAR(x_at(30 * ms), 1.95, 1e-12);
}

TEST_F(CameraHistoryTest, KeepsTheNewestAndDropsTheOldest) {
  constexpr auto kept = static_cast<std::int64_t>(SampleRing<int>::capacity);
  for (std::int64_t i = 0; i < 3 * kept; ++i) add(i * ms, static_cast<double>(i));
  EXPECT_EQ(x_at(2 * kept * ms - 1), -1);
  EXPECT_EQ(x_at(2 * kept * ms), 2 * kept);
  EXPECT_NEAR(x_at((3 * kept - 1) * ms - ms / 2), 3 * kept - 1.5, 1e-9);
  add(ms, 5);
  EXPECT_EQ(x_at(2 * kept * ms), 2 * kept) << "one that is too old replaces none that is kept";
}

TEST_F(CameraHistoryTest, EachPartHasItsOwnTime) {
  for (int i = 0; i < 5; ++i) {
    auto camera = camera_at(i, 10 + i);
    camera.pose.linear() = camera::rotation_of({10.0 * i, 0, 0});
    history->add(camera, start + i * 20 * ms, start + i * 20 * ms);
  }
  const auto found = history->at({start + 30 * ms, start + 50 * ms, start + 70 * ms}, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->camera.pose.translation().x(), 1.5, 1e-12);
  EXPECT_NEAR(camera::pan_tilt_roll(found->camera.pose.linear()).pan, 25, 1e-9);
  EXPECT_NEAR(found->camera.lens.image_distance, 13.5, 1e-12);
  EXPECT_EQ(found->margins.position, 50 * ms);
  EXPECT_EQ(found->margins.rotation, 30 * ms);
  EXPECT_EQ(found->margins.lens, 10 * ms);
}

/// One CameraInfo per frame, and poses five times as often, each with the CameraInfo before it.
TEST_F(CameraHistoryTest, ALensWithItsOwnTimesIsInterpolatedByThem) {
  for (int i = 0; i <= 20; ++i) {
    const std::int64_t frame = i / 5;
    history->add(camera_at(i, static_cast<double>(10 + frame)), start + i * 8 * ms, start + frame * 40 * ms);
  }
  const std::int64_t at = start + 50 * ms;
  const auto found = history->at({at, at, at}, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->camera.lens.image_distance, 11.25, 1e-12);
  EXPECT_EQ(found->margins.position, 110 * ms);
  EXPECT_EQ(found->margins.lens, 110 * ms) << "a lens that does not move is no missing sample";
}

TEST_F(CameraHistoryTest, AChangedLensWithAnOldTimeGetsTheTimeOfThePose) {
  history->add(camera_at(0), start, start - 1000 * ms);
  history->add(camera_at(1), start + 20 * ms, start - 1000 * ms);
  history->add(camera_at(2, 14), start + 40 * ms, start - 1000 * ms);
  const std::int64_t at = start + 40 * ms;
  EXPECT_EQ(history->at({at, at, at}, 0)->camera.lens.image_distance, 14);
}

}  // namespace trk_bridge::bridge::camera_history_test
