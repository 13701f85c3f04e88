// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Samples of a tracker as a network delivers them, on simulated time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace trk_bridge::bridge {

enum class Jitter { gauss, uniform, exponential, mixed };

inline std::string name_of(Jitter jitter) {
  switch (jitter) {
    case Jitter::gauss:
      return "gauss";
    case Jitter::uniform:
      return "uniform";
    case Jitter::exponential:
      return "exponential";
    case Jitter::mixed:
      return "mixed";
  }
  return "";
}

/// A delivered sample. Times in ns.
struct Delivered {
  std::uint64_t counter = 0;
  double sampled = 0;  ///< since the start of the signal
  std::int64_t arrival = 0;
};

struct Signal {
  Jitter jitter = Jitter::gauss;
  double rate = 50;  ///< Hz, nominal
  unsigned seed = 1;
  double seconds = 60;
  double deviation = 2e6;  ///< ns, standard
  double ppm = 100;        ///< by which a count takes longer
  double loss = 0.01, duplicates = 0.01;
  /// Of the n-th sample: its counter, its time in ns, and its delay in addition to jitter.
  std::function<std::uint64_t(std::uint64_t)> counter = [](std::uint64_t n) { return n; };
  std::function<double(std::uint64_t, double)> time = [](std::uint64_t n, double interval) {
    return static_cast<double>(n) * interval;
  };
  std::function<double(double)> delay = [](double) { return 0; };
  /// Samples that would arrive from `stall` on arrive `stall_lasts` later in a burst. Seconds since the start.
  double stall = -1, stall_lasts = 0;
};

inline constexpr double signal_delay = 30e6;  // ns, constant
inline constexpr std::int64_t signal_begin = 1'700'000'000'000'000'000;

/// With losses, duplicates and in order of arrival. Jitter of 2 ms changes the order of some.
inline std::vector<Delivered> deliver(const Signal& signal) {
  std::mt19937_64 engine(signal.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::exponential_distribution<double> exponential;
  const auto jitter = [&]() -> double {
    switch (signal.jitter) {
      case Jitter::gauss:
        return normal(engine);
      case Jitter::uniform:
        return std::sqrt(12.0) * uniform(engine);
      case Jitter::exponential:
        return exponential(engine);
      case Jitter::mixed: {
        // |normal|; 5 % are ten times as late.
        const double mean_square = 0.95 + 0.05 * 100, mean = std::sqrt(2 / M_PI) * (0.95 + 0.05 * 10);
        const double late = std::abs(normal(engine)) * (uniform(engine) < 0.05 ? 10 : 1);
        return late / std::sqrt(mean_square - mean * mean);
      }
    }
    return 0;
  };
  const double interval = 1e9 / signal.rate * (1 + 1e-6 * signal.ppm);
  std::vector<Delivered> delivered;
  for (std::uint64_t n = 0;; ++n) {
    const double time = signal.time(n, interval);
    if (time > signal.seconds * 1e9) break;
    const double late = signal_delay + signal.deviation * jitter() + signal.delay(time);
    const bool is_lost = uniform(engine) < signal.loss, comes_twice = uniform(engine) < signal.duplicates;
    if (is_lost) continue;
    delivered.push_back({signal.counter(n), time, signal_begin + std::llround(time + late)});
    if (!comes_twice) continue;
    delivered.push_back(delivered.back());
    delivered.back().arrival += 3'000'000;
  }
  std::stable_sort(delivered.begin(), delivered.end(),
                   [](const Delivered& a, const Delivered& b) { return a.arrival < b.arrival; });
  const std::int64_t held = signal_begin + std::llround(signal.stall * 1e9);
  std::int64_t released = held + std::llround(signal.stall_lasts * 1e9);
  for (Delivered& d : delivered) {
    if (d.arrival >= held && d.arrival < released) d.arrival = released += 20'000;
  }
  return delivered;
}

}  // namespace trk_bridge::bridge
