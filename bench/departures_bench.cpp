// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Measures how even departures are, the age of sent sets, and the time per set: departures_bench [SECONDS], at 50 Hz.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "bridge/departures.h"
#include "trk_bridge/wire/format.h"

namespace {

using trk_bridge::base::steady_now;
using trk_bridge::base::wall_now;
using trk_bridge::bridge::DepartureOptions;
using trk_bridge::bridge::Departures;
using trk_bridge::bridge::Destination;
using trk_bridge::bridge::Feed;
using trk_bridge::bridge::PacedCamera;

constexpr std::int64_t period = 20'000'000;

double part_of(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

trk_bridge::wire::CameraParams params_at(std::int64_t time) {
  trk_bridge::wire::CameraParams params;
  params.format = trk_bridge::wire::euler;
  params.euler.pan = 20 * std::sin(static_cast<double>(time % 1'000'000'000'000) * 3e-9);
  params.fov = 20;
  return params;
}

/// Deviations of intervals from the period, ms.
std::vector<double> deviations_of(const std::vector<double>& at) {
  std::vector<double> deviations;
  for (std::size_t i = 1; i < at.size(); ++i) deviations.push_back(std::abs(at[i] - at[i - 1] - period / 1e6));
  return deviations;
}

/// The limit of the machine: a thread that only waits.
void measure_timer(int seconds) {
  std::vector<double> at;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < seconds * 50; ++i) {
    std::this_thread::sleep_until(begin + std::chrono::nanoseconds(i * period));
    at.push_back(static_cast<double>(steady_now()) / 1e6);
  }
  const auto deviations = deviations_of(at);
  std::printf("  a timer alone     %6.3f %6.3f %6.3f\n", part_of(deviations, 0.5), part_of(deviations, 0.99),
              part_of(deviations, 1));
}

/// Samples that arrive up to `jitter` ns late, uniformly distributed.
void measure(int seconds, std::int64_t delay, std::int64_t jitter) {
  std::vector<double> at, age;
  Destination destination;
  destination.timing.delay = {delay, delay, delay};
  destination.is_paced = true;
  destination.write = [&](const auto&, const trk_bridge::transport::RecordTime& time) {
    at.push_back(static_cast<double>(steady_now()) / 1e6);
    age.push_back(static_cast<double>(wall_now() - time.nanoseconds) / 1e6);
  };
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> late(0, jitter);
  {
    Departures departures(DepartureOptions{50.0, Feed::one_camera, wall_now}, {destination});
    const auto begin = std::chrono::steady_clock::now();
    const std::int64_t wall = wall_now();
    for (int i = 0; i < seconds * 50; ++i) {
      const std::int64_t time = i * period;
      std::this_thread::sleep_until(begin + std::chrono::nanoseconds(time + late(random)));
      departures.write(params_at(wall + time), wall + time);
    }
  }
  // Without the first two seconds.
  at.erase(at.begin(), at.begin() + 100);
  age.erase(age.begin(), age.begin() + 100);
  const auto deviations = deviations_of(at);
  std::printf("%8.1f %8.1f   %6.3f %6.3f %6.3f   %6.2f %6.2f\n", static_cast<double>(delay) / 1e6,
              static_cast<double>(jitter) / 1e6, part_of(deviations, 0.5), part_of(deviations, 0.99),
              part_of(deviations, 1), part_of(age, 0.5), part_of(age, 0.99));
}

void measure_cost() {
  constexpr int sets = 200'000;
  const auto camera = std::make_unique<PacedCamera>(
      50, std::vector<trk_bridge::bridge::OutputTiming>{{{6'000'000, 6'000'000, 6'000'000}, 0}});
  int sent = 0;
  const auto begin = steady_now();
  for (int i = 0; i < sets; ++i) {
    const std::int64_t now = begin + i * period;
    static_cast<void>(camera->add(params_at(now), now, 0, now, now));
    if (!camera->due()) continue;
    camera->depart(now + 100, now + 100);
    sent += camera->take(0, now + 100, now + 100) ? 1 : 0;
  }
  std::printf("one set, from sample to departure: %.0f ns (%d sets)\n",
              static_cast<double>(steady_now() - begin) / sets, sent);
}

}  // namespace

int main(int argc, char** argv) {
  const int seconds = argc > 1 ? std::atoi(argv[1]) : 20;
  std::printf("delay ms  jitter ms   intervals off 20 ms by     age, ms\n");
  std::printf("                        p50    p99    max      p50    p99\n");
  measure_timer(seconds);
  for (const std::int64_t jitter : {0, 2'000'000}) {
    for (const std::int64_t delay : {0, 6'000'000, 40'000'000}) measure(seconds, delay, jitter);
  }
  measure_cost();
}
