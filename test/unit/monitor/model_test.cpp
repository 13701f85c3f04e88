// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/model.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "memory_feed.h"
#include "trk_bridge/wire/format.h"
#include "udp.h"

namespace trk_bridge::monitor::model_test {

using std::chrono::milliseconds;

class ModelTest : public testing::Test {
 protected:
  /// A sample that arrives, and is given to the model, `at` after the start.
  void add(const wire::Record& record, milliseconds at, std::uint32_t port = 5000) {
    transport::Sample sample;
    sample.record = record;
    sample.arrival = std::chrono::nanoseconds(at).count();
    sample.sender = test::MemoryFeed::sender(port);
    model.add(sample, begin + at);
  }
  State state(milliseconds at) { return model.state(begin + at, *feed.source()); }

  test::MemoryFeed feed;
  const Model::Time begin{std::chrono::hours(5)};
  Model model{begin};
};

TEST_F(ModelTest, KnowsNothingAtFirst) {
  const auto s = state(milliseconds(0));
  EXPECT_TRUE(s.cameras.empty());
  EXPECT_FALSE(s.malformed);
  EXPECT_EQ(s.source_name, feed.source()->name());
}

TEST_F(ModelTest, ReportsRateCounterLossAndAge) {
  for (const std::uint64_t counter : {100U, 101U, 103U, 102U, 103U, 104U}) {
    add(test::params(counter, 7), milliseconds(20 * static_cast<int>(counter - 100)));
  }
  const auto s = state(milliseconds(105));
  ASSERT_EQ(s.cameras.size(), 1U);
  const auto& camera = s.cameras.front();
  EXPECT_EQ(camera.key.id, 7U);
  EXPECT_EQ(camera.counts.lost, 0U);  // 102 was late
  EXPECT_EQ(camera.counts.late, 1U);
  EXPECT_EQ(camera.counts.duplicates, 1U);
  EXPECT_EQ(camera.latest->params.counter, 104U);
  EXPECT_NEAR(camera.latest->age, 0.025, 1e-9);
  // New are 100, 101, 103, 104: three intervals in 80 ms.
  EXPECT_DOUBLE_EQ(camera.rate.value(), 37.5);
  EXPECT_EQ(camera.jitter.value().interval, 20'000'000);
  EXPECT_EQ(camera.jitter.value().worst, 20'000'000);
}

TEST_F(ModelTest, WithoutACounterEveryRecordIsNew) {
  transport::Sample sample;
  sample.has_counter = sample.has_lens = false;
  sample.encoders.zoom = 5;
  for (int i = 0; i < 5; ++i) {
    sample.record = test::params(0, 7);
    sample.arrival = i * 20'000'000;
    model.add(sample, begin + milliseconds(20 * i));
  }
  const auto s = state(milliseconds(90));
  ASSERT_EQ(s.cameras.size(), 1U);
  const auto& camera = s.cameras.front();
  EXPECT_EQ(camera.counts.accepted, 5U);
  EXPECT_EQ(camera.counts.duplicates, 0U);
  EXPECT_EQ(camera.counts.state, base::CounterState::ignored);
  EXPECT_DOUBLE_EQ(camera.rate.value(), 50);
  EXPECT_EQ(camera.latest->lens.error(), camera::CameraReason::no_lens);
  EXPECT_EQ(camera.latest->encoders.zoom, 5);
}

TEST_F(ModelTest, ARecordThatComesTwiceIsNotNew) {
  for (std::uint64_t n = 0; n < 50; ++n) {
    add(test::params(n), milliseconds(20 * static_cast<int>(n)));
    add(test::params(n), milliseconds(20 * static_cast<int>(n) + 1));
  }
  const auto s = state(milliseconds(1000));
  EXPECT_EQ(s.cameras.front().counts.duplicates, 50U);
  EXPECT_NEAR(s.cameras.front().rate.value(), 50, 1e-9);
}

TEST_F(ModelTest, ACounterThatStandsStillIsAFindingAndNotSilence) {
  for (int at = 0; at <= 2000; at += 20) add(test::params(5), milliseconds(at));
  add(test::constants(), milliseconds(2000));
  const auto s = state(milliseconds(2000));
  EXPECT_FALSE(s.cameras.front().latest->is_silent);
  EXPECT_EQ(s.findings.front().condition, bridge::Condition::uncounted);
  EXPECT_THAT(s.findings.front().text, testing::HasSubstr("the counter stands still"));
}

TEST_F(ModelTest, AResetClearsEverything) {
  for (std::uint64_t n = 0; n < 10; ++n) add(test::params(2 * n), milliseconds(20 * static_cast<int>(n)));
  EXPECT_EQ(state(milliseconds(200)).findings.front().condition, bridge::Condition::lost);
  const auto source = feed.source();
  feed.put(test::params(1));
  transport::Reception reception;
  ASSERT_EQ(source->receive(reception, {}), transport::Event::sample);
  Model fresh(begin + milliseconds(200), source->statistics());
  const auto s = fresh.state(begin + milliseconds(300), *source);
  EXPECT_TRUE(s.cameras.empty());
  EXPECT_EQ(s.source.records, 0U);
  EXPECT_NEAR(s.age, 0.1, 1e-9);
}

TEST_F(ModelTest, AFrozenStateDoesNotChange) {
  add(test::params(1), milliseconds(20));
  const auto live = state(milliseconds(20));
  const auto kept = frozen(live);
  add(test::params(2), milliseconds(40));
  EXPECT_EQ(live.cameras.front().history->newest(), 40'000'000) << "it belongs to the model";
  EXPECT_EQ(kept.cameras.front().history->newest(), 20'000'000);
}

TEST_F(ModelTest, SilenceIsMoreThanASecondAndThreeIntervals) {
  add(test::params(5), milliseconds(0));
  EXPECT_FALSE(state(milliseconds(1000)).cameras.front().latest->is_silent);
  EXPECT_TRUE(state(milliseconds(1001)).cameras.front().latest->is_silent);
  add(test::params(6), milliseconds(2000));
  add(test::params(7), milliseconds(4000));
  EXPECT_FALSE(state(milliseconds(9900)).cameras.front().latest->is_silent);
  EXPECT_TRUE(state(milliseconds(10'100)).cameras.front().latest->is_silent);
}

TEST_F(ModelTest, ReportsPoseAndLensInCanonicalForm) {
  auto params = test::params(1);
  params.format = wire::euler | wire::field_of_view;
  params.fov = 40;
  auto constants = test::constants();
  constants.chip_width = constants.fake_chip_width = 8.8;
  add(params, milliseconds(0));
  {
    const auto s = state(milliseconds(0));
    const auto& latest = *s.cameras.front().latest;
    ASSERT_TRUE(latest.pose);
    EXPECT_DOUBLE_EQ(latest.pose->translation().x(), 1.5);
    EXPECT_FALSE(latest.lens);
    EXPECT_EQ(latest.lens.error(), camera::CameraReason::constants_needed);
    EXPECT_FALSE(s.cameras.front().constants);
  }
  add(constants, milliseconds(1));
  const auto s = state(milliseconds(1));
  const auto& latest = *s.cameras.front().latest;
  ASSERT_TRUE(latest.lens);
  EXPECT_NEAR(latest.lens->image_distance, 8.8 / 2 / std::tan(20 * M_PI / 180), 1e-9);
  ASSERT_TRUE(latest.horizontal_angle);
  EXPECT_NEAR(*latest.horizontal_angle, 40, 1e-9);
}

TEST_F(ModelTest, NoPoseIfTheMatrixIsNotARotation) {
  wire::CameraParams params;
  params.fov = 10;
  add(params, milliseconds(0));
  const auto s = state(milliseconds(0));
  ASSERT_FALSE(s.cameras.front().latest->pose);
  EXPECT_EQ(s.cameras.front().latest->pose.error(), camera::CameraReason::not_a_rotation);
}

TEST_F(ModelTest, CamerasThatSendComeFirst) {
  add(test::params(1, 1), milliseconds(0));
  add(test::params(1, 9), milliseconds(2000));
  add(test::params(1, 4), milliseconds(2000), 6000);
  add(test::params(1, 4), milliseconds(2000), 5000);
  add(test::constants(720, 2), milliseconds(2000));
  const auto s = state(milliseconds(2000));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  for (const auto& camera : s.cameras) order.emplace_back(camera.key.id, camera.key.sender.number);
  EXPECT_THAT(order, testing::ElementsAre(testing::Pair(4, 5000), testing::Pair(4, 6000), testing::Pair(9, 5000),
                                          testing::Pair(1, 5000), testing::Pair(2, 5000)));
}

TEST_F(ModelTest, RemembersTheLastMalformedRecord) {
  transport::Reception reception;
  reception.fault = wire::Fault{wire::Reason::not_a_number, 9, true};
  reception.sample.sender = test::MemoryFeed::sender(6000);
  model.add_malformed(reception, begin);
  const auto s = state(milliseconds(1500));
  ASSERT_TRUE(s.malformed);
  EXPECT_EQ(s.malformed->fault.field(), 9);
  EXPECT_EQ(s.malformed->sender, test::MemoryFeed::sender(6000));
  EXPECT_DOUBLE_EQ(s.malformed->age, 1.5);
}

TEST_F(ModelTest, ACameraAtRestHasItsNoise) {
  for (int n = 0; n <= 200; ++n) {
    auto params = test::params(static_cast<std::uint64_t>(n));
    params.euler.z += n % 2 * 0.002;
    add(params, milliseconds(20 * n));
  }
  const auto rest = state(milliseconds(4000)).cameras.front().rest;
  ASSERT_EQ(rest.motion, Motion::still);
  EXPECT_NEAR(rest.deviation[2], 0.001, 1e-5);
  EXPECT_NEAR(rest.deviation[3], 0, 1e-9);
}

TEST_F(ModelTest, CamerasBeyondTheLimitAreOnlyCounted) {
  for (std::uint32_t id = 1; id <= 260; ++id) add(test::params(1, id), milliseconds(0));
  const auto s = state(milliseconds(0));
  EXPECT_EQ(s.cameras.size(), cli::Tally::most_cameras);
  EXPECT_EQ(s.not_shown, 4U);
}

}  // namespace trk_bridge::monitor::model_test
