// What a counter says about the record that carries it: next, lost, late, twice, or a tracker that restarted.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace trk_bridge::base {

/// How far the counters of a camera are trusted.
enum class CounterUse : std::uint8_t {
  /// They order the records, as long as they count them: no sender of fresh values is ever ignored.
  automatic,
  strict,  ///< they order the records, whatever they do
  ignore,  ///< they say nothing: every record is new
};

/// The verdict on one counter.
enum class Order : std::uint8_t {
  first,
  next,       ///< newer than all before; those missing between are counted as lost
  duplicate,  ///< a record that came before, the newest one or a late one
  late,       ///< older than the newest: out of order
  restarted,  ///< too far back to be late, or ahead by more than `restart_ahead`: a new count begins
  uncounted,  ///< taken as it comes: the counter stands still or is not used
};

/// Whether a record with this verdict is new and in order.
constexpr bool is_new(Order order) noexcept { return order != Order::duplicate && order != Order::late; }

/// What the counter of a camera does.
enum class CounterState : std::uint8_t {
  counts,
  cycles,   ///< it begins again every second or two, as the frame of a second does
  frozen,   ///< it does not change, or its records repeat: all are taken as they come until it counts again
  ignored,  ///< CounterUse::ignore
};

/// `accepted` counts the verdicts for which is_new() is true.
struct SequenceCounts {
  std::uint64_t accepted = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
  CounterState state = CounterState::counts;
};

/// Judges the counters of one camera. Not synchronised, never allocates.
///
/// A late record that had been counted as lost is taken off that count again, and so is not mistaken for a duplicate,
/// as far as `window` counts behind the newest; one older than that is late. A counter of 16, 31, 32 or 64 bits that
/// wraps goes on (0xFFFFFFFF, 0 is next).
///
/// With CounterUse::automatic a record is a duplicate only when all of it came within the last second, and late only
/// when its counter is missing among the last `late_reach`. Any other counter that goes back is a restart. After more
/// than `repeats_allowed` duplicates in a row the counter stands.
class Sequence {
 public:
  /// `field_rate` in Hz, more than 0 and at most 1e6: how many counts a second has. Throws std::invalid_argument.
  explicit Sequence(double field_rate = 50.0, CounterUse use = CounterUse::strict);

  /// Judges the next record's counter and counts the verdict. `fingerprint` is equal for equal records and hardly ever
  /// for others; only CounterUse::automatic looks at it.
  Order judge(std::uint64_t counter, std::uint64_t fingerprint = 0) noexcept;
  /// The next record comes from another sender: its counter is the first one.
  void forget_newest() noexcept { newest_.reset(); }

  /// The same as in the constructor, where it becomes known later. What is no rate changes nothing.
  void use_field_rate(double field_rate) noexcept;

  /// How many counts the last record is ahead of the newest one before it; 0 unless its verdict was Order::next.
  std::uint64_t step() const noexcept { return step_; }

  const SequenceCounts& counts() const noexcept { return counts_; }

  /// Seconds' worth of counts a jump ahead may have before it is a restart and not loss.
  static constexpr double restart_ahead = 60.0;
  /// Counts behind the newest that are remembered: a second of 240 Hz.
  static constexpr std::size_t window = 256;
  /// With CounterUse::automatic: counts behind the newest that a late record may be.
  static constexpr std::uint64_t late_reach = 16;
  /// Late records in a row; more are a restart to a counter a little below.
  static constexpr unsigned lates_allowed = 8;
  /// Duplicates in a row. A datagram that comes on several ways is no reason to distrust its counter.
  static constexpr unsigned repeats_allowed = 3;

 private:
  Order order_of(std::uint64_t counter, std::uint64_t fingerprint) noexcept;
  Order ahead(std::uint64_t counter, std::uint64_t by) noexcept;
  Order back(std::uint64_t counter, std::uint64_t by, std::uint64_t fingerprint) noexcept;
  Order begin_at(std::uint64_t counter, Order verdict) noexcept;
  /// `by` counts behind the newest, among the last `window`.
  Order fill(std::uint64_t by) noexcept;
  bool came(std::uint64_t by) const noexcept { return by == 0 || (by <= window && came_.test(by - 1)); }
  bool is_known(std::uint64_t fingerprint) const noexcept;
  /// The counter went back by less than a circle, or not on. Twice within a circle is no accident.
  void note_return(CounterState) noexcept;
  void watch(Order) noexcept;

  CounterUse use_;
  std::uint64_t second_;         // counts
  std::uint64_t restart_ahead_;  // counts
  std::optional<std::uint64_t> newest_;
  std::uint64_t step_ = 0;    // counts
  std::uint64_t span_ = 0;    // from the first counter of this run to the newest
  std::bitset<window> came_;  // bit n: newest_ - 1 - n came

  // Of CounterUse::automatic.
  std::array<std::uint64_t, window> fingerprints_{};  // of the last second's records without duplicates
  std::size_t next_fingerprint_ = 0;
  unsigned repeats_ = 0, lates_ = 0;  // in a row
  std::uint64_t steady_ = 0;          // Order::next in a row
  std::uint64_t since_return_;        // records since note_return()

  SequenceCounts counts_;
};

}  // namespace trk_bridge::base
