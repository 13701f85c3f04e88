// When to look for the next set of a writer that wakes nobody.
#pragma once

#include <cstdint>

namespace trk_bridge::shm {

/// Learns the rhythm of a writer from the looks that found its sets, and says when to look next: all the time around
/// the moment at which a set is expected, seldom between. How wide that is follows from how evenly the writer writes
/// and how exactly this machine ends a sleep. What looks cost is limited: where the sets of an uneven writer would take
/// more than `share` of a core, looks are further apart. A writer that stops is looked for ever more seldom.
///
/// Times are ns of the steady clock. A value; allocates nothing.
class Cadence {
 public:
  /// A writer may write from `now` on.
  explicit Cadence(std::int64_t now) noexcept;

  /// A look at `now` found so many sets that were not there at the look before.
  void looked(std::int64_t now, unsigned sets) noexcept;
  /// What the sleep before the next look took of a core, ns.
  void slept(std::int64_t cost) noexcept;
  /// When to look next. Not after `now`: again at once.
  std::int64_t next(std::int64_t now) noexcept;

  /// ns between the sets; 0: not known.
  double period() const noexcept { return period_; }
  /// ns, mean deviation of a set from the moment at which it was expected.
  double deviation() const noexcept { return deviation_; }

  /// Of a core, what looks at an even or uneven writer may take; each set is looked for once all the same.
  static constexpr double share = 0.012;
  /// ns: longer pauses between looks do not occur.
  static constexpr std::int64_t slowest = 100'000'000;

 private:
  /// What the next look comes after.
  enum class Before : std::uint8_t { nothing, short_sleep, sleep };

  bool is_known() const noexcept { return period_ > 0; }
  void pay(std::int64_t now) noexcept;
  void found(std::int64_t now, unsigned sets) noexcept;
  void learn(std::int64_t now, unsigned sets) noexcept;
  void forget() noexcept;
  /// ns between looks that there is always credit for.
  double affordable_sleep() const noexcept { return sleep_cost_ / share; }
  double sleep_while_unknown(std::int64_t now) noexcept;

  double period_ = 0;
  double expected_ = 0;  // the next set, ns after last_look_
  double deviation_ = 0;
  unsigned tracked_ = 0;  // sets since the period is known, up to a limit
  int strays_ = 0;        // sets in a row at another time than expected
  int missed_ = 0;        // expected moments in a row without a set

  std::int64_t last_look_, last_found_;
  double uncertainty_ = 0;  // ns, of last_found_
  double interval_ = 0;     // the last one, while the period is not known; 0: none
  bool has_found_ = false;
  bool is_fast_ = false;  // the last two sets came within a few ms

  Before before_ = Before::nothing;
  std::int64_t planned_ = 0;
  double late_ = 50'000, late_deviation_ = 20'000;  // ns, by which sleeps end later than planned

  // ns of a core.
  double credit_, learning_credit_;
  double sleep_cost_ = 20'000;  // of a sleep, mean
  double cost_ = 0;             // of the sleeps since the last look
};

}  // namespace trk_bridge::shm
