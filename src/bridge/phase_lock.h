// Departures at an even rhythm, just behind the samples that they send.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace trk_bridge::bridge {

/// Follows the rhythm in which samples arrive, by the steady clock (ns), through jitter, gaps and bursts. Departures
/// follow each other at the rate, where there is one, and else at that of the samples. Where the two rates are a
/// multiple of each other to 0.5 %, departures are locked to the samples: each is `wait()` behind an expected arrival
/// (or, where there are more departures than samples, behind one and in even parts of the time to the next). Where they
/// are not, departures have the rate and the phase drifts. Not synchronised. Allocates nothing.
class PhaseLock {
 public:
  /// `rate` in Hz; none: that of the samples, once some have come.
  explicit PhaseLock(std::optional<double> rate = std::nullopt) noexcept;

  void arrive(std::int64_t now) noexcept;

  /// The first departure after `now`; none before it can be known: a sample has come, or, without a rate, six.
  std::optional<std::int64_t> next(std::int64_t now) noexcept;

  /// ns between departures; 0: not known yet.
  double period() const noexcept;
  /// ns between samples; that of departures until it is known.
  double sample_period() const noexcept { return is_known() ? sample_period_ : period_; }
  bool is_locked() const noexcept { return step() > 0; }
  /// ns, how long after an expected arrival a departure is: a little, and three times the samples' mean deviation, at
  /// most 0.8 ms, or a quarter of their period.
  double wait() const noexcept;

  /// Samples that come within less than this belong together, ns.
  static constexpr std::int64_t least_interval = 500'000;

 private:
  static constexpr std::size_t first_intervals = 5;

  bool is_known() const noexcept { return intervals_ == first_intervals; }
  void start_over(std::int64_t now) noexcept;
  void learn(std::int64_t interval) noexcept;
  void correct(double periods, double error) noexcept;
  /// ns between departures that are locked; 0: they are not.
  double step() const noexcept;

  double period_;                     // that is asked for; 0: that of the samples
  std::optional<std::int64_t> last_;  // arrival
  std::array<std::int64_t, first_intervals> first_{};
  std::size_t intervals_ = 0;
  double sample_period_ = 0;
  std::int64_t origin_ = 0;  // near an arrival: keeps phase_ small, and exact
  double phase_ = 0;         // ns after origin_, the expected arrival of the newest sample
  double deviation_ = 0;     // ns, mean
  std::uint64_t samples_ = 0;
  int strays_ = 0;                         // in a row
  std::optional<std::int64_t> departure_;  // the last one
};

}  // namespace trk_bridge::bridge
