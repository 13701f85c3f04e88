// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A camera in simulated time: what is sent is compared with the camera's true position.
#include "bridge/paced_camera.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge::paced_camera_test {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t second = 1'000 * ms;
constexpr std::int64_t start = 1'700'000'000 * second;
constexpr std::int64_t steady_start = 1'234 * second + 777;  // of another clock
constexpr double chip_width = 9.6;

double seconds(std::int64_t time) { return static_cast<double>(time - start) / 1e9; }
/// 60 degrees a second at most, +-20 degrees.
double pan_at(std::int64_t time) { return 20 * std::sin(3 * seconds(time)); }
/// In mm, from 8 to 32 and back in 4 s.
double focal_length_at(std::int64_t time) { return 20 + 12 * std::sin(seconds(time) * 1.5707963); }

wire::CameraParams record_at(std::int64_t time) {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler.x = seconds(time);
  params.euler.pan = pan_at(time);
  params.fov = focal_length_at(time);
  return params;
}

struct Sample {
  std::int64_t time, arrival;  // both of the clock of start
  wire::CameraParams params;
};
/// `count` samples with this `period`, each received `latency` later.
std::vector<Sample> samples(int count, std::int64_t period = 20 * ms, std::int64_t latency = ms / 5,
                            const std::function<wire::CameraParams(std::int64_t)>& record = record_at) {
  std::vector<Sample> all;
  for (int i = 0; i < count; ++i) {
    const std::int64_t time = start + i * period;
    all.push_back({time, time + latency, record(time)});
    all.back().params.counter = static_cast<std::uint64_t>(i) + 1;
  }
  return all;
}

struct Sent {
  std::int64_t at;  // of the clock of start
  wire::CameraParams params;
  std::int64_t time;
};

constexpr std::int64_t steady(std::int64_t time) { return time - start + steady_start; }

/// Replays samples in order of arrival.
std::vector<Sent> play(PacedCamera& camera, const std::vector<Sample>& samples, std::size_t output = 0) {
  std::vector<Sent> sent;
  const auto take = [&](std::int64_t at) {
    if (const auto one = camera.take(output, steady(at), at)) sent.push_back({at, one->params, one->time});
  };
  for (const auto& sample : samples) {
    while (camera.due() && *camera.due() <= steady(sample.arrival)) {
      const std::int64_t at = *camera.due() - steady_start + start;
      camera.depart(*camera.due(), at);
      take(at);
    }
    EXPECT_TRUE(camera.add(sample.params, sample.time, 0, steady(sample.arrival), sample.arrival));
    if (camera.waits(steady(sample.arrival))) take(sample.arrival);
  }
  return sent;
}

OutputTiming delayed(double ms_late) {
  const auto ns = static_cast<std::int64_t>(ms_late * 1e6);
  return {{ns, ns, ns}, 0};
}

/// Of the sets that are sent later than one second after the start.
void expect_right(const std::vector<Sent>& sent, std::int64_t delay) {
  int checked = 0;
  for (const auto& one : sent) {
    if (one.at < start + second) continue;
    const std::int64_t then = one.at - delay;
    EXPECT_NEAR(one.params.euler.pan, pan_at(then), 0.01) << seconds(one.at);
    EXPECT_NEAR(one.params.euler.x, seconds(then), 1e-6);
    EXPECT_NEAR(one.params.fov / focal_length_at(then), 1, 0.001) << seconds(one.at);
    EXPECT_NEAR(static_cast<double>(one.time - then), 0, 1);
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST(PacedCamera, PanAndZoomAreRightAThirdOfAFieldLate) {
  PacedCamera camera(50, {delayed(6)});
  expect_right(play(camera, samples(500)), 6 * ms);
  EXPECT_EQ(camera.statistics(0).negative, 0u);
}

TEST(PacedCamera, PanAndZoomAreRightAtAnyDelayAndWithoutARate) {
  for (const double delay : {6.0, 13.7, 40.0, 400.0}) {
    PacedCamera camera(std::nullopt, {delayed(delay)});
    expect_right(play(camera, samples(500)), static_cast<std::int64_t>(delay * 1e6));
  }
}

/// An angle of view is sent; its focal length is compared with the camera's.
TEST(PacedCamera, AnAngleOfViewIsAsExactAsAFocalLength) {
  const auto as_angle = [](std::int64_t time) {
    auto params = record_at(time);
    params.format |= wire::field_of_view;
    params.fov = 2 * std::atan(chip_width / 2 / focal_length_at(time)) * 180 / M_PI;
    return params;
  };
  PacedCamera camera(50, {delayed(6)});
  auto sent = play(camera, samples(500, 20 * ms, ms / 5, as_angle));
  for (auto& one : sent) one.params.fov = chip_width / 2 / std::tan(one.params.fov / 2 * M_PI / 180);
  expect_right(sent, 6 * ms);
}

TEST(PacedCamera, TheAgeDoesNotDependOnThePhaseOfTheStart) {
  for (const double delay : {0.0, 6.0, 25.0}) {
    for (const std::int64_t latency : {ms / 10, 7 * ms + 123'456, 19 * ms}) {
      // The samples' times are their arrivals, as of a node without the crane's clock.
      auto all = samples(300);
      for (auto& sample : all) sample.time = (sample.arrival += latency) - ms / 10;
      PacedCamera camera(50, {delayed(delay)});
      const auto sent = play(camera, all);
      EXPECT_GT(sent.size(), 290u);
      for (const auto& one : sent) {
        if (one.at < start + second) continue;
        const double age = static_cast<double>(one.at - one.time) / 1e6;
        EXPECT_GE(age, delay);
        EXPECT_LE(age, delay == 0 ? 1 : delay + 1e-6);
      }
    }
  }
}

TEST(PacedCamera, EachPartHasItsOwnDelay) {
  PacedCamera camera(50, {{{30 * ms, 6 * ms, 14 * ms}, 0}});
  for (const auto& one : play(camera, samples(200))) {
    if (one.at < start + second) continue;
    EXPECT_NEAR(one.params.euler.x, seconds(one.at - 30 * ms), 1e-6);
    EXPECT_NEAR(one.params.euler.pan, pan_at(one.at - 6 * ms), 0.01);
    EXPECT_NEAR(one.params.fov, focal_length_at(one.at - 14 * ms), 0.02);
  }
}

/// An even tilt over the top, 90 degrees a second.
TEST(PacedCamera, ATiltThrough90DegreesIsEven) {
  const auto over_the_top = [](std::int64_t time) {
    const double angle = 90 * (seconds(time) - 1);  // 90 degrees at 2 s
    auto params = record_at(time);
    const auto angles = camera::pan_tilt_roll(camera::rotation_of({0, angle, 0}));
    params.euler.pan = angles.pan;
    params.euler.tilt = angles.tilt;
    params.euler.roll = angles.roll;
    return params;
  };
  PacedCamera camera(50, {delayed(6)});
  for (const auto& one : play(camera, samples(180, 20 * ms, ms / 5, over_the_top))) {
    const double angle = 90 * (seconds(one.at) - 0.006 - 1) * M_PI / 180;
    const Eigen::Matrix3d rotation = camera::decode_pose(one.params).value().linear();
    EXPECT_NEAR((rotation.col(1) - Eigen::Vector3d(0, std::cos(angle), std::sin(angle))).norm(), 0, 1e-6);
    EXPECT_NEAR((rotation.col(0) - Eigen::Vector3d::UnitX()).norm(), 0, 1e-6);
  }
}

TEST(PacedCamera, OneLostSampleIsNotVisibleWithADelayOfAFieldOrMore) {
  for (const double delay : {20.5, 30.0}) {
    auto all = samples(300);
    for (const int lost : {103, 155, 208}) all.erase(all.begin() + lost);
    PacedCamera camera(50, {delayed(delay)});
    const auto sent = play(camera, all);
    for (std::size_t i = 1; i < sent.size(); ++i) {
      if (sent[i].at < start + second) continue;
      EXPECT_NEAR(static_cast<double>(sent[i].at - sent[i - 1].at), 20e6, 0.3e6) << "none is missing";
      EXPECT_EQ(sent[i].params.counter, sent[i - 1].params.counter + 1);
      EXPECT_NEAR(sent[i].params.euler.x - sent[i - 1].params.euler.x, 0.02, 0.0004) << "equal steps";
      // A chord over two fields instead of one: 20 degrees * 9 / s^2 * (0.04 s)^2 / 8.
      EXPECT_NEAR(sent[i].params.euler.pan, pan_at(sent[i].at - static_cast<std::int64_t>(delay * 1e6)), 0.037);
    }
  }
}

/// The next sample arrives just before the departure; the departures after that must not be early.
TEST(PacedCamera, AfterALostSampleWithoutADelayDeparturesKeepTheirRhythm) {
  auto all = samples(300);
  all.erase(all.begin() + 150);
  PacedCamera camera(50, {delayed(0)});
  const auto sent = play(camera, all);
  for (std::size_t i = 60; i + 1 < sent.size(); ++i) {
    const double interval = static_cast<double>(sent[i + 1].at - sent[i].at);
    EXPECT_NEAR(interval, interval > 30e6 ? 40e6 : 20e6, 0.05e6) << i;
  }
}

TEST(PacedCamera, LateSamplesNeverMoveItBack) {
  auto all = samples(400);
  for (std::size_t i = 60; i < all.size(); i += 7) {
    all[i].arrival += static_cast<std::int64_t>(i % 5) * 13 * ms;
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.arrival < b.arrival; });
  for (const double delay : {0.0, 6.0, 30.0}) {
    for (const std::int64_t lead : {std::int64_t{0}, 40 * ms}) {
      PacedCamera camera(50, {{delayed(delay).delay, lead}});
      const auto sent = play(camera, all);
      EXPECT_GT(sent.size(), 350u);
      for (std::size_t i = 1; i < sent.size(); ++i) {
        EXPECT_GT(sent[i].time, sent[i - 1].time);
        // x is the time; it increases linearly, so that interpolated and extrapolated values are right as well.
        EXPECT_NEAR(sent[i].params.euler.x, seconds(sent[i].time), 1e-6);
      }
    }
  }
}

TEST(PacedCamera, LeadExtrapolatesWithoutSamplesAndStops) {
  for (const std::int64_t lead : {std::int64_t{0}, 15 * ms, 40 * ms}) {
    auto all = samples(100);
    const std::int64_t newest = all.back().time;
    // A much later sample lets the time without samples pass.
    all.push_back({newest + 900 * ms, newest + 900 * ms, all.back().params});
    PacedCamera camera(50, {{{}, lead}});
    const auto sent = play(camera, all);
    EXPECT_EQ(sent.back().time, newest + lead);
    EXPECT_NEAR(sent.back().params.euler.x, seconds(newest + lead), 1e-6);
    EXPECT_LT(sent.back().at, newest + 70 * ms) << "nothing is sent repeatedly";
  }
}

TEST(PacedCamera, MarginAndHowOftenItWasNegative) {
  // At a departure the newest sample is 0.6 ms old (0.2 ms of latency, 0.4 ms of wait): of 20 ms of delay, 19.4 ms
  // are left.
  PacedCamera enough(50, {delayed(20)});
  play(enough, samples(500));
  const auto& good = enough.statistics(0);
  EXPECT_EQ(good.negative, 0u);
  EXPECT_NEAR(good.margin_sum / static_cast<double>(good.departures), 0.97, 0.01);
  EXPECT_NEAR(good.age_sum / static_cast<double>(good.sent), 20e6, 1e3);
  // A latency of 12 ms does not fit into a delay of 6: what is sent is older.
  PacedCamera too_little(50, {delayed(6)});
  play(too_little, samples(500, 20 * ms, 12 * ms));
  const auto& bad = too_little.statistics(0);
  EXPECT_GT(bad.departures, 480u);
  EXPECT_EQ(bad.negative, bad.departures);
  EXPECT_NEAR(bad.margin_sum / static_cast<double>(bad.departures), -(12 + 0.4 - 6) / 20, 0.01);
  EXPECT_NEAR(bad.age_sum / static_cast<double>(bad.sent), 12.4e6, 0.2e6);
}

TEST(PacedCamera, APartWithoutADelayIsTheNewestAndHasNoMargin) {
  PacedCamera camera(50, {{{30 * ms, 30 * ms, 0}, 0}});
  play(camera, samples(300));
  EXPECT_EQ(camera.statistics(0).negative, 0u);
}

TEST(PacedCamera, OutputsOfSeveralDelaysFollowOneCamera) {
  PacedCamera camera(50, {delayed(6), delayed(50)});
  const auto all = samples(400);
  std::vector<double> differences;
  for (const auto& sample : all) {
    while (camera.due() && *camera.due() <= steady(sample.arrival)) {
      const std::int64_t now = *camera.due(), at = now - steady_start + start;
      camera.depart(now, at);
      const auto first = camera.take(0, now, at), second_one = camera.take(1, now, at);
      if (first && second_one) differences.push_back(first->params.euler.x - second_one->params.euler.x);
    }
    ASSERT_TRUE(camera.add(sample.params, sample.time, 0, steady(sample.arrival), sample.arrival));
  }
  ASSERT_GT(differences.size(), 390u);
  for (const double one : differences) EXPECT_NEAR(one, 0.044, 1e-6);
}

TEST(PacedCamera, AClockThatIsSetCostsLessThanASecond) {
  for (const std::int64_t step : {5 * second, -5 * second, 3600 * second, -3600 * second}) {
    auto all = samples(300);
    PacedCamera camera(50, {delayed(40)});
    std::vector<Sent> sent;
    for (std::size_t i = 0; i < all.size(); ++i) {
      // From the 100th sample on, both the samples' times and the clock are different.
      const std::int64_t set = i < 100 ? 0 : step;
      while (camera.due() && *camera.due() <= steady(all[i].arrival)) {
        const std::int64_t now = *camera.due(), at = now - steady_start + start + set;
        camera.depart(now, at);
        if (const auto one = camera.take(0, now, at))
          sent.push_back({now - steady_start + start, one->params, one->time});
      }
      ASSERT_TRUE(camera.add(all[i].params, all[i].time + set, 0, steady(all[i].arrival), all[i].arrival + set));
    }
    std::int64_t longest = 0;
    for (std::size_t i = 1; i < sent.size(); ++i) longest = std::max(longest, sent[i].at - sent[i - 1].at);
    EXPECT_LT(longest, second) << step;
    EXPECT_NEAR(static_cast<double>(sent.back().time - step - sent.back().at), -40e6, 1) << step;
    EXPECT_NEAR(sent.back().params.euler.x, seconds(sent.back().at - 40 * ms), 1e-6) << step;
  }
}

TEST(PacedCamera, AClockThatIsSetBackALittleIsWaitedFor) {
  constexpr std::int64_t back = -310 * ms;
  PacedCamera camera(50, {delayed(40)});
  std::vector<std::int64_t> times;
  const auto all = samples(300);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::int64_t set = i < 100 ? 0 : back;
    while (camera.due() && *camera.due() <= steady(all[i].arrival)) {
      const std::int64_t now = *camera.due(), at = now - steady_start + start + set;
      camera.depart(now, at);
      if (const auto one = camera.take(0, now, at)) times.push_back(one->time);
    }
    ASSERT_TRUE(camera.add(all[i].params, all[i].time + set, 0, steady(all[i].arrival), all[i].arrival + set));
  }
  EXPECT_GT(times.size(), 270u);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
}

/// A take's time code can be of any day: the age of a sample is counted from its arrival, and the take's times are
/// sent.
TEST(PacedCamera, TimesOfAnotherDayAreUsedRelatively) {
  PacedCamera camera(50, {delayed(30)});
  auto all = samples(200);
  constexpr std::int64_t day = 86'400 * second;
  for (auto& sample : all) sample.time -= 1000 * day;
  for (const auto& one : play(camera, all)) {
    if (one.at < start + second) continue;
    EXPECT_NEAR(static_cast<double>(one.time + 1000 * day - (one.at - 30 * ms)), 0, 0.3e6);
    EXPECT_NEAR(one.params.euler.x, seconds(one.time + 1000 * day), 1e-6);
  }
}

TEST(PacedCamera, WithoutTimesArrivalsAreUsed) {
  PacedCamera camera(50, {delayed(30)});
  auto all = samples(200);
  for (auto& sample : all) sample.time = 0;
  const auto sent = play(camera, all);
  ASSERT_GT(sent.size(), 150u);
  EXPECT_NEAR(sent.back().params.euler.x, seconds(sent.back().at - 30 * ms - ms / 5), 1e-6);
}

/// Without sample times a late record and a duplicate look new; they are recognised by their counters.
TEST(PacedCamera, OldRecordsThatArriveLateAreNotTreatedAsNew) {
  PacedCamera camera(50, {delayed(6)});
  auto all = samples(300);
  for (std::size_t i = 40; i + 3 < all.size(); i += 25) {
    std::swap(all[i].params, all[i + 1].params);
    all[i + 3].params = all[i + 2].params;
  }
  for (auto& sample : all) sample.time = 0;
  const auto sent = play(camera, all);
  EXPECT_GT(sent.size(), 250u);
  for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_GE(sent[i].params.euler.x, sent[i - 1].params.euler.x);
  EXPECT_EQ(camera.statistics(0).ignored, 22u);
}

TEST(PacedCamera, AnotherFormatIsNotInterpolatedWithTheOneBefore) {
  PacedCamera camera(50, {delayed(30)});
  auto all = samples(200);
  for (std::size_t i = 100; i < all.size(); ++i) {
    all[i].params.format |= wire::field_of_view;
    all[i].params.fov = 60;
  }
  for (const auto& one : play(camera, all)) {
    if (wire::has(one.params.format, wire::field_of_view)) {
      EXPECT_NEAR(one.params.fov, 60, 1e-9);
    } else {
      EXPECT_LT(one.params.fov, 33);
    }
  }
}

TEST(PacedCamera, InvalidCamerasAreRefusedWithoutAffectingOthers) {
  PacedCamera camera(50, {delayed(30)});
  auto bad = record_at(start);
  bad.euler.x = std::nan("");
  EXPECT_EQ(camera.add(bad, start, 0, steady(start), start).error(), camera::CameraReason::not_finite);
  const auto sent = play(camera, samples(50));
  EXPECT_GT(sent.size(), 40u);
}

}  // namespace trk_bridge::bridge::paced_camera_test
