// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/departures.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "base/clock.h"
#include "camera_records.h"
#include "deadline.h"

namespace trk_bridge::bridge::departures_test {

using testing::ElementsAre;

constexpr std::int64_t ms = 1'000'000;

/// What a destination has received, and in which threads.
class Inbox {
 public:
  Destination destination(const OutputTiming& timing = {}, bool is_paced = false) {
    return {timing, is_paced,
            [this](const wire::Record& record, const transport::RecordTime& time) {
              const std::lock_guard<std::mutex> lock(mutex_);
              records_.push_back({record, time.nanoseconds, base::wall_now()});
              if (std::this_thread::get_id() == test_) ++in_caller_;
            },
            [this](const Loss& loss) { losses.push_back(loss); }};
  }

  struct Got {
    wire::Record record;
    std::int64_t time, at;
  };
  std::vector<Got> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return records_;
  }
  std::vector<wire::Record> records() const {
    std::vector<wire::Record> found;
    for (const auto& got : all()) found.push_back(got.record);
    return found;
  }
  std::size_t in_caller() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return in_caller_;
  }

  std::vector<Loss> losses;

 private:
  const std::thread::id test_ = std::this_thread::get_id();
  mutable std::mutex mutex_;
  std::vector<Got> records_;
  std::size_t in_caller_ = 0;
};

DepartureOptions options(std::optional<double> rate = 50) { return {rate, Feed::passed_on, base::wall_now}; }

OutputTiming delay(std::int64_t ns) { return {{ns, ns, ns}, 0}; }

/// x is the time of the sample in seconds.
wire::CameraParams at(std::int64_t time, std::uint64_t counter, std::uint32_t id = 0) {
  auto params = test::params(counter, id);
  params.euler.x = static_cast<double>(time % 1'000'000'000'000) / 1e9;
  return params;
}

/// Samples with the current time, every 10 ms, until the condition is met.
template <typename Condition>
bool feed_until(Departures& departures, Condition&& condition, std::vector<std::uint32_t> ids = {0}) {
  for (std::uint64_t counter = 1; counter < 6000; ++counter) {
    for (const auto id : ids) {
      const auto now = base::wall_now();
      departures.write(at(now, counter, id), now);
    }
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(Departures, WithoutATimingEverythingIsSentUnchangedAtOnce) {
  Inbox inbox;
  Departures departures(options(), {inbox.destination()});
  auto bad = test::params(2);
  bad.euler.x = std::nan("");
  departures.write(test::params(1), 5);
  departures.write(test::constants());
  departures.write(test::params(1), 6);
  departures.write(bad);
  EXPECT_EQ(inbox.in_caller(), 4u);
  EXPECT_EQ(inbox.records().at(0), wire::Record(test::params(1)));
  EXPECT_EQ(inbox.all().at(0).time, 5);
  EXPECT_EQ(inbox.records().at(1), wire::Record(test::constants()));
  EXPECT_FALSE(departures.statistics(0));
}

TEST(Departures, ADelayAppliesToParametersButNotToConstants) {
  Inbox plain, delayed;
  Departures departures(options(), {plain.destination(), delayed.destination(delay(80 * ms))});
  departures.write(test::constants());
  departures.write(test::constants());
  ASSERT_TRUE(feed_until(departures, [&] { return delayed.all().size() > 20; }));
  EXPECT_EQ(delayed.in_caller(), 0u);
  EXPECT_GT(plain.in_caller(), 20u);
  const auto got = delayed.all();
  EXPECT_EQ(got.front().record, wire::Record(test::constants()));
  for (std::size_t i = 1; i < got.size(); ++i) {
    const auto* params = std::get_if<wire::CameraParams>(&got[i].record);
    ASSERT_NE(params, nullptr) << "the same constants are not new";
    EXPECT_EQ(params->counter, i);
    // Each set contains the camera of its time, which is at least the delay ago.
    EXPECT_NEAR(params->euler.x, at(got[i].time, 0).euler.x, 2e-6);
    EXPECT_GE(got[i].at - got[i].time, 80 * ms);
    if (i > 1) {
      EXPECT_GT(got[i].time, got[i - 1].time);
    }
  }
  EXPECT_EQ(departures.statistics(1)->sent, got.size() - 1);
}

TEST(Departures, ATimingCanBeChangedIfATimerSends) {
  Inbox plain, paced;
  Departures departures(options(), {plain.destination(), paced.destination({}, true)});
  EXPECT_FALSE(departures.set_timing(0, delay(80 * ms)));
  ASSERT_TRUE(feed_until(departures, [&] { return paced.all().size() > 10; }));
  ASSERT_TRUE(departures.set_timing(1, delay(300 * ms)));
  const auto before = paced.all().size();
  ASSERT_TRUE(feed_until(departures, [&] { return paced.all().size() > before + 20; }));
  const auto got = paced.all();
  for (std::size_t i = 1; i < got.size(); ++i) EXPECT_GT(got[i].time, got[i - 1].time);
  EXPECT_GE(got.back().at - got.back().time, 300 * ms);
  ASSERT_TRUE(departures.set_timing(1, delay(20 * ms)));
  // A shorter delay continues from the camera's current position; a busy machine may be late.
  ASSERT_TRUE(feed_until(departures, [&] {
    const auto last = paced.all().back();
    return last.at - last.time < 200 * ms;
  }));
}

TEST(Departures, DelayedSamplesAreSentAtTheEnd) {
  for (const std::int64_t late : {std::int64_t{0}, 200 * ms}) {
    Inbox inbox;
    Departures departures(options(), {inbox.destination(delay(late), true)});
    std::int64_t last = 0;
    for (std::uint64_t counter = 1; counter <= 5; ++counter) {
      last = base::wall_now();
      departures.write(at(last, counter), last);
      if (late == 0) {
        EXPECT_TRUE(test::becomes_true([&] { return inbox.all().size() == counter; }));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    departures.finish();
    ASSERT_FALSE(inbox.all().empty());
    EXPECT_EQ(inbox.all().back().time, last) << "the newest sample itself";
    EXPECT_GE(base::wall_now() - last, late);
  }
}

TEST(Departures, EveryIdHasItsOwnOutput) {
  Inbox inbox;
  Departures departures(options(std::nullopt), {inbox.destination(delay(30 * ms))});
  ASSERT_TRUE(feed_until(departures, [&] { return inbox.all().size() > 40; }, {3, 8}));
  std::uint64_t of_3 = 0, of_8 = 0;
  for (const auto& got : inbox.all()) {
    const auto& params = std::get<wire::CameraParams>(got.record);
    EXPECT_EQ(params.counter, params.id == 3 ? ++of_3 : ++of_8);
  }
  EXPECT_GT(of_3, 10u);
  EXPECT_GT(of_8, 10u);
}

TEST(Departures, OneCameraMayChangeItsId) {
  Inbox inbox;
  auto one_camera = options();
  one_camera.feed = Feed::one_camera;
  Departures departures(one_camera, {inbox.destination({}, true)});
  ASSERT_TRUE(feed_until(departures, [&] { return inbox.all().size() > 5; }, {3}));
  ASSERT_TRUE(
      feed_until(departures, [&] { return std::get<wire::CameraParams>(inbox.all().back().record).id == 8; }, {8}));
}

TEST(Departures, InvalidCamerasArePassedToTheDestination) {
  Inbox inbox;
  Departures departures(options(), {inbox.destination(delay(30 * ms))});
  auto bad = test::params(2);
  bad.k1 = std::nan("");
  departures.write(bad, 7);
  EXPECT_TRUE(test::becomes_true([&] { return inbox.all().size() == 1; }));
  EXPECT_TRUE(std::isnan(std::get<wire::CameraParams>(inbox.records().at(0)).k1));
  EXPECT_EQ(inbox.all().at(0).time, 7);
}

TEST(Departures, TooManyIdsAreALoss) {
  Inbox inbox;
  Departures departures(options(), {inbox.destination(delay(30 * ms))});
  for (std::uint32_t id = 0; id < OutletWriter::most_ids; ++id) departures.write(test::constants(720, id));
  EXPECT_TRUE(inbox.losses.empty());
  departures.write(test::params(1, 9000));
  ASSERT_EQ(inbox.losses.size(), 1u);
  EXPECT_EQ(inbox.losses[0].id, 9000u);
  EXPECT_EQ(std::get<OutletReason>(inbox.losses[0].cause), OutletReason::too_many_ids);
  EXPECT_TRUE(test::becomes_true([&] { return inbox.all().size() == OutletWriter::most_ids; }));
}

}  // namespace trk_bridge::bridge::departures_test
