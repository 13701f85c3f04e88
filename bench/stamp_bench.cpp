// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The time that the stamp of a sample takes.
#include <benchmark/benchmark.h>

#include <array>
#include <random>

#include "bridge/counter_clock.h"

namespace {

using namespace trk_bridge::bridge;

void stamp(benchmark::State& state) {
  std::array<std::int64_t, 4096> jitter{};
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal(0, 2e6);
  for (auto& one : jitter) one = static_cast<std::int64_t>(normal(engine));
  CounterClock clock;
  std::int64_t time = 1'700'000'000'000'000'000;
  std::size_t i = 0;
  for (auto _ : state) {
    time += 20'000'000;
    benchmark::DoNotOptimize(clock.stamp(1, time + jitter[++i % jitter.size()]));
  }
}
BENCHMARK(stamp);

}  // namespace

BENCHMARK_MAIN();
