// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Departures at an even rhythm, shortly after the samples that they send.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace trk_bridge::bridge {

/// Tracks the rhythm in which samples arrive (steady clock, ns) through jitter, gaps and bursts. Departures have the
/// given rate, or that of the samples. If one rate is a multiple of the other within 0.5 %, departures are locked to
/// the samples: each is `wait()` after an expected arrival (if there are more departures than samples, the time to the
/// next one is divided evenly). Otherwise departures have the given rate, and the phase drifts. Not synchronised. Does
/// not allocate.
class PhaseLock {
 public:
  /// `rate` in Hz; none: that of the samples, once it is known.
  explicit PhaseLock(std::optional<double> rate = std::nullopt) noexcept;

  void arrive(std::int64_t now) noexcept;

  /// The first departure after `now`; none before the first sample has arrived or, without a rate, before the sixth.
  std::optional<std::int64_t> next(std::int64_t now) noexcept;

  /// ns between departures; 0: not known yet.
  double period() const noexcept;
  /// ns between samples; until it is known, that of departures.
  double sample_period() const noexcept { return is_known() ? sample_period_ : period_; }
  bool is_locked() const noexcept { return step() > 0; }
  /// ns from an expected arrival to its departure: 0.3 ms plus three times the mean deviation of the samples, at most
  /// 0.8 ms and at most a quarter of their period.
  double wait() const noexcept;

  /// ns; samples closer together than this count as one.
  static constexpr std::int64_t least_interval = 500'000;

 private:
  static constexpr std::size_t first_intervals = 5;

  bool is_known() const noexcept { return intervals_ == first_intervals; }
  void start_over(std::int64_t now) noexcept;
  void learn(std::int64_t interval) noexcept;
  void correct(double periods, double error) noexcept;
  /// ns between locked departures; 0: they are not locked.
  double step() const noexcept;

  double period_;                     // the given one; 0: that of the samples
  std::optional<std::int64_t> last_;  // arrival
  std::array<std::int64_t, first_intervals> first_{};
  std::size_t intervals_ = 0;
  double sample_period_ = 0;
  std::int64_t origin_ = 0;  // near an arrival: keeps phase_ small and exact
  double phase_ = 0;         // ns after origin_, the expected arrival of the newest sample
  double deviation_ = 0;     // ns, mean
  std::uint64_t samples_ = 0;
  int strays_ = 0;                         // in a row
  std::optional<std::int64_t> departure_;  // the last one
};

}  // namespace trk_bridge::bridge
