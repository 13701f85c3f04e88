// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// How the stamps of a camera's pipeline are calculated.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>

#include "bridge/camera_pipeline.h"
#include "pipeline_samples.h"

namespace trk_bridge::bridge::camera_pipeline_stamps_test {

/// A sample of a tracker of 50 Hz whose arrivals jitter by 3 ms.
transport::Sample jittering(std::uint64_t n) {
  return sample(params(n),
                today + static_cast<std::int64_t>(n) * field + static_cast<std::int64_t>(n * 7 % 4) * 1'000'000);
}

CameraOptions stamped_by(StampMode stamp) {
  CameraOptions options;
  options.stamp = stamp;
  return options;
}

/// Stamps of the fields from `from` on, minus their number of fields since midnight.
std::vector<std::int64_t> feed(CameraPipeline& pipeline, std::uint64_t from, std::uint64_t to) {
  std::vector<std::int64_t> offsets;
  for (std::uint64_t n = from; n < to; ++n) {
    const auto made = pipeline.process(jittering(n), 0);
    EXPECT_TRUE(made.pose);
    offsets.push_back(made.stamp - today - static_cast<std::int64_t>(n) * field);
  }
  return offsets;
}

std::int64_t width(const std::vector<std::int64_t>& offsets) {
  const auto [least, most] = std::minmax_element(offsets.begin(), offsets.end());
  return *most - *least;
}

TEST(CameraPipeline, StampsByCounterHaveItsRhythmMinusTheDelay) {
  CameraOptions options = stamped_by(StampMode::counter);
  options.delay = 0.04;
  CameraPipeline pipeline(options, std::nullopt);
  EXPECT_EQ(width(feed(pipeline, 0, 90)), 3'000'000);
  EXPECT_EQ(pipeline.statistics().stamp_state, StampState::learning);
  feed(pipeline, 90, 500);
  EXPECT_EQ(pipeline.statistics().stamp_state, StampState::counter);
  const auto offsets = feed(pipeline, 500, 1000);
  EXPECT_LT(width(offsets), 300'000);
  EXPECT_LT(offsets.back(), -40'000'000);
  EXPECT_GT(offsets.back(), -45'000'000);
  EXPECT_NEAR(pipeline.statistics().rhythm.interval, field, 200);
  EXPECT_EQ(pipeline.statistics().held_stamps, 0u);

  CameraPipeline by_arrival(stamped_by(StampMode::arrival), 50);
  EXPECT_EQ(width(feed(by_arrival, 0, 1000)), 3'000'000);
  EXPECT_EQ(by_arrival.statistics().stamp_state, StampState::arrival);
  EXPECT_NEAR(by_arrival.statistics().rhythm.interval, field, 200) << "known nevertheless";
}

TEST(CameraPipeline, StampsAreArrivalsIfTheCounterDoesNotCount) {
  struct Case {
    StampState state;
    base::CounterUse use;
    bool has_counter;
    std::function<std::uint64_t(std::uint64_t)> counter_of;
  };
  const auto count = [](std::uint64_t n) { return n; };
  for (const auto& c : std::vector<Case>{
           {StampState::uncounted, base::CounterUse::automatic, true, [](std::uint64_t) { return 7; }},
           {StampState::uncounted, base::CounterUse::automatic, true, [](std::uint64_t n) { return n % 30; }},
           {StampState::uncounted, base::CounterUse::ignore, true, count},
           {StampState::no_counter, base::CounterUse::automatic, false, count}}) {
    CameraOptions options = stamped_by(StampMode::counter);
    options.counter = c.use;
    CameraPipeline pipeline(options, std::nullopt);
    for (std::uint64_t n = 0; n < 1000; ++n) {
      auto s = jittering(n);
      std::get<wire::CameraParams>(s.record).counter = c.counter_of(n);
      std::get<wire::CameraParams>(s.record).euler.x = static_cast<double>(n);
      s.has_counter = c.has_counter;
      const auto made = pipeline.process(s, 0);
      if (n < 500) continue;
      EXPECT_EQ(made.stamp, s.arrival);
      EXPECT_EQ(pipeline.statistics().stamp_state, c.state);
    }
  }
}

TEST(CameraPipeline, AnotherSenderIsMeasuredFromItsStart) {
  CameraPipeline pipeline(stamped_by(StampMode::counter), std::nullopt);
  feed(pipeline, 0, 500);
  ASSERT_EQ(pipeline.statistics().stamp_state, StampState::counter);
  auto other = jittering(600);
  other.sender.number = 1;
  EXPECT_EQ(pipeline.process(other, second).stamp, other.arrival);
  EXPECT_EQ(pipeline.statistics().failovers, 1u);
  EXPECT_EQ(pipeline.statistics().stamp_state, StampState::learning);
}

TEST(CameraPipeline, StampsOfTheSenderAreItsTimesOrArrivals) {
  CameraOptions options = stamped_by(StampMode::source);
  options.delay = 0.04;
  CameraPipeline pipeline(options, 50);
  auto s = jittering(1);
  EXPECT_EQ(pipeline.process(s, 0).stamp, s.arrival - 40'000'000);
  EXPECT_EQ(pipeline.statistics().stamp_state, StampState::no_source_time);
  EXPECT_FALSE(pipeline.statistics().source_behind);
  s = jittering(2);
  s.sample_time = today + 37 * second;
  EXPECT_EQ(pipeline.process(s, 0).stamp, today + 37 * second - 40'000'000);
  EXPECT_EQ(pipeline.statistics().stamp_state, StampState::source);
  EXPECT_EQ(pipeline.statistics().source_behind, s.arrival - *s.sample_time);
}

TEST(CameraPipeline, ALongerDelayNeverMovesStampsBack) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  const auto before = pipeline.process(sample(params(1), today), 0).stamp;
  LiveOptions live;
  live.delay = 0.1;
  pipeline.set(live);
  auto newest = before;
  for (int i = 1; i < 10; ++i) {
    const auto stamp = pipeline.process(sample(params(1 + static_cast<std::uint64_t>(i)), today + i * field), 0).stamp;
    EXPECT_GT(stamp, newest);
    newest = stamp;
  }
  EXPECT_EQ(newest, today + 9 * field - 100'000'000);
}

TEST(CameraPipeline, ATimeOutsideOfRosTimeIsDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  EXPECT_FALSE(pipeline.process(sample(params(1), -1), 0).pose);
  EXPECT_EQ(pipeline.statistics().unstampable, 1u);
  EXPECT_TRUE(pipeline.process(sample(params(2)), 0).pose);
}

}  // namespace trk_bridge::bridge::camera_pipeline_stamps_test
