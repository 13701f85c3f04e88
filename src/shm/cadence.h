// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Schedules polling for the next set of a writer that does not wake its readers.
#pragma once

#include <cstdint>

namespace trk_bridge::shm {

/// Learns the period of a writer from the polls that found its sets, and returns the time of the next poll: polling is
/// continuous around the time at which a set is expected, and rare in between. The width of this window depends on the
/// jitter of the writer and on how exactly this machine ends a sleep. The cost is limited: if an irregular writer would
/// take more than `share` of a core, the polls are further apart. If a writer stops, polls become rarer and rarer.
///
/// Times are in ns, of the steady clock. Copyable; allocates nothing.
class Cadence {
 public:
  /// The writer may start at `now`.
  explicit Cadence(std::int64_t now) noexcept;

  /// Reports that a poll at `now` found this number of new sets.
  void polled(std::int64_t now, unsigned sets) noexcept;
  /// Reports the CPU time of the sleep before the next poll, ns.
  void slept(std::int64_t cost) noexcept;
  /// The time of the next poll. If it is not after `now`: at once.
  std::int64_t next(std::int64_t now) noexcept;

  /// ns between sets; 0: unknown.
  double period() const noexcept { return period_; }
  /// Mean deviation of a set from its expected time, ns.
  double deviation() const noexcept { return deviation_; }

  /// The share of a core that polling may use; each set is polled for at least once.
  static constexpr double share = 0.012;
  /// The longest time between polls, ns.
  static constexpr std::int64_t slowest = 100'000'000;

 private:
  /// What happened before the next poll.
  enum class Before : std::uint8_t { nothing, short_sleep, sleep };

  bool is_known() const noexcept { return period_ > 0; }
  void pay(std::int64_t now) noexcept;
  void found(std::int64_t now, unsigned sets) noexcept;
  void learn(std::int64_t now, unsigned sets) noexcept;
  void forget() noexcept;
  /// The time between polls that is always affordable, ns.
  double affordable_sleep() const noexcept { return sleep_cost_ / share; }
  double sleep_while_unknown(std::int64_t now) noexcept;

  double period_ = 0;
  double expected_ = 0;  // the next set, ns after last_poll_
  double deviation_ = 0;
  unsigned tracked_ = 0;  // sets since the period became known, up to a limit
  int outliers_ = 0;      // sets in a row at an unexpected time
  int missed_ = 0;        // expected times in a row without a set

  std::int64_t last_poll_, last_found_;
  double uncertainty_ = 0;  // ns, of last_found_
  double interval_ = 0;     // the last one, while the period is unknown; 0: none
  bool has_found_ = false;
  bool is_fast_ = false;  // the last two sets came within a few ms

  Before before_ = Before::nothing;
  std::int64_t planned_ = 0;
  double late_ = 50'000, late_deviation_ = 20'000;  // ns by which sleeps end later than planned

  // ns of CPU time.
  double credit_, learning_credit_;
  double sleep_cost_ = 20'000;  // mean of a sleep
  double cost_ = 0;             // of the sleeps since the last poll
};

}  // namespace trk_bridge::shm
