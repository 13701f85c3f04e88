// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Computes when samples were taken from the rhythm of their counter: arrival times without network jitter.
#pragma once

#include <cstdint>

namespace trk_bridge::bridge {

/// A television rate.
struct StandardRate {
  const char* name;  ///< "59.94"
  double rate;       ///< Hz, exact
};
/// The standard rate within 300 ppm of `rate` (Hz); null if there is none.
const StandardRate* standard_rate(double rate) noexcept;

/// Results of a CounterClock. Trivially copyable. Times in ns.
struct CounterClockStatistics {
  bool learned = false;            ///< stamps follow the counter; false: they are arrivals
  double interval = 0;             ///< per count; 0 until it is known
  double jitter_before = 0;        ///< standard deviation of the arrivals from the line, without outliers
  double jitter_after = 0;         ///< of the stamps: the standard error of the line
  std::uint64_t outliers = 0;      ///< arrivals that were not used to correct the line
  std::uint64_t steps = 0;         ///< of the path's delay
  double last_step = 0;            ///< valid if steps > 0; positive: the delay became longer
  std::uint64_t restarts = 0;      ///< how often the counter restarted or jumped after its rhythm was known
  std::uint64_t rate_changes = 0;  ///< how often the rate was measured again
};

/// Fits arrival(n) = t0 + interval * n + jitter to the samples of one sender with an alpha-beta filter with fading
/// memory. A stamp is on that line, minus 3.3 standard deviations of the jitter: at the early edge of the arrivals,
/// because the constant part of the delay cannot be measured at one end. The rate is measured; there is nothing to
/// configure. Not synchronised, never allocates.
class CounterClock {
 public:
  /// The stamp of the next sample, ns on the clock of `arrival` (since 1970; not in the last second that the type can
  /// hold): never after `arrival`, at most `most_early` before it, and later than the stamp before if `arrival` is
  /// later. `counts`: by how much the counter increased since the sample before; 0 if that is unknown because the
  /// counter restarted.
  [[nodiscard]] std::int64_t stamp(std::uint64_t counts, std::int64_t arrival) noexcept;

  /// Starts over: the next sample is from another sender, or its counter does not count.
  void forget() noexcept;

  const CounterClockStatistics& statistics() const noexcept { return statistics_; }

  static constexpr double most_early = 0.5e9;  ///< ns
  static constexpr double learning = 2e9;      ///< ns after the first sample during which stamps are arrivals

 private:
  void begin() noexcept;
  void follow(double counts, double elapsed) noexcept;
  void resume() noexcept;
  void note(double error, double counts, double elapsed, bool is_outlier) noexcept;
  void correct(double error, double counts) noexcept;
  bool is_long_run() const noexcept;
  bool has_stepped() const noexcept;
  void step() noexcept;
  void move_line(double by, double samples) noexcept;
  double outlier_limit() const noexcept;
  double before_arrival() const noexcept;

  /// Outliers on one side, without another sample between them.
  struct Run {
    double samples = 0;
    double span = 0;    // ns
    double errors = 0;  // ns, their sum
    double first_counts = 0;
  };

  double samples_ = 0;         // that the line was fitted to; 0: there is no line
  double offset_samples_ = 0;  // that its offset was fitted to
  std::int64_t arrival_ = 0;   // of the last sample
  double line_ = 0;            // ns, relative to arrival_
  double interval_ = 0;        // ns
  double age_ = 0;             // ns, since the line was started or interrupted

  double deviation_ = 0;  // ns, mean absolute error of `deviations_` samples
  double deviations_ = 0;
  double recent_error_ = 0;     // ns, mean of the last seconds
  double recent_outliers_ = 0;  // share of the last seconds' samples
  Run run_;
  double since_step_ = 0;  // ns
  double gap_ = 0;         // ns, from the line to the line before a step; closed slowly

  std::int64_t newest_ = 0;
  CounterClockStatistics statistics_;
};

}  // namespace trk_bridge::bridge
