// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Classifies records by their counters: next, late, duplicate, or a tracker that restarted; counts what was lost.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace trk_bridge::base {

/// How the counters of a camera are used.
enum class CounterUse : std::uint8_t {
  /// They order the records as long as they count; a sender of new values is never ignored.
  automatic,
  strict,  ///< they always order the records
  ignore,  ///< they are not used: every record is new
};

/// The result for one counter.
enum class Order : std::uint8_t {
  first,
  next,       ///< newer than all before; counters missing in between are counted as lost
  duplicate,  ///< a record that was received before, as the newest or as a late one
  late,       ///< older than the newest: out of order
  restarted,  ///< too far back to be late, or ahead by more than `restart_ahead`: a new run begins
  uncounted,  ///< accepted without a check: the counter is frozen or not used
};

/// Whether a record with this result is new and in order.
constexpr bool is_new(Order order) noexcept { return order != Order::duplicate && order != Order::late; }

/// How the counter of a camera behaves.
enum class CounterState : std::uint8_t {
  counts,
  cycles,   ///< it restarts every second or two, like the frame number of a time code
  frozen,   ///< it does not change, or its records repeat: all are accepted until it counts again
  ignored,  ///< CounterUse::ignore
};

/// `accepted` counts the results for which is_new() is true.
struct SequenceCounts {
  std::uint64_t accepted = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
  CounterState state = CounterState::counts;
};

/// Classifies the counters of one camera. Not synchronised, never allocates.
///
/// A late record that was counted as lost is subtracted from that count, and is not mistaken for a duplicate. This
/// works up to `window` counts before the newest; an older record is late. A counter of 16, 31, 32 or 64 bits may wrap
/// (0 is next after 0xFFFFFFFF).
///
/// With CounterUse::automatic, a record is a duplicate only if an equal record was received within the last second, and
/// late only if its counter is missing among the last `late_reach`. Any other counter that goes back is a restart.
/// After more than `repeats_allowed` duplicates in a row, the counter is frozen.
class Sequence {
 public:
  /// `field_rate`: counts per second, more than 0 and at most 1e6 Hz. Throws std::invalid_argument.
  explicit Sequence(double field_rate = 50.0, CounterUse use = CounterUse::strict);

  /// Classifies the counter of the next record and counts the result. `fingerprint` is equal for equal records and
  /// almost never for others; only CounterUse::automatic uses it.
  Order classify(std::uint64_t counter, std::uint64_t fingerprint = 0) noexcept;
  /// The next record comes from another sender: its counter is the first one.
  void forget_newest() noexcept { newest_.reset(); }

  /// As in the constructor, if the rate becomes known later. An invalid rate changes nothing.
  void use_field_rate(double field_rate) noexcept;

  /// How many counts the last record is ahead of the newest one before it; 0 unless its result was Order::next.
  std::uint64_t step() const noexcept { return step_; }

  const SequenceCounts& counts() const noexcept { return counts_; }

  /// A jump ahead by more than the counts of this many seconds is a restart and not a loss.
  static constexpr double restart_ahead = 60.0;
  /// How many counts before the newest are stored: about a second at 240 Hz.
  static constexpr std::size_t window = 256;
  /// With CounterUse::automatic: how many counts before the newest a late record may be.
  static constexpr std::uint64_t late_reach = 16;
  /// Late records in a row; more are a restart at a counter a little lower.
  static constexpr unsigned lates_allowed = 8;
  /// Duplicates in a row. A datagram may arrive on several paths; this does not make its counter invalid.
  static constexpr unsigned repeats_allowed = 3;

 private:
  Order order_of(std::uint64_t counter, std::uint64_t fingerprint) noexcept;
  Order ahead(std::uint64_t counter, std::uint64_t by) noexcept;
  Order back(std::uint64_t counter, std::uint64_t by, std::uint64_t fingerprint) noexcept;
  Order begin_at(std::uint64_t counter, Order verdict) noexcept;
  /// In `received_`, of the counter that is `by` counts before the newest; `by` is from 1 to `window`.
  static std::size_t bit_of(std::uint64_t by) noexcept { return static_cast<std::size_t>(by - 1); }
  /// A counter that is `by` counts before the newest.
  Order fill(std::uint64_t by) noexcept;
  bool received(std::uint64_t by) const noexcept { return by == 0 || (by <= window && received_.test(bit_of(by))); }
  bool is_known(std::uint64_t fingerprint) const noexcept;
  /// The counter went back by less than a cycle, or did not change. Twice within a cycle, this sets the state.
  void note_backward_jump(CounterState) noexcept;
  void update_state(Order) noexcept;

  CounterUse use_;
  std::uint64_t second_;         // counts
  std::uint64_t restart_ahead_;  // counts
  std::optional<std::uint64_t> newest_;
  std::uint64_t step_ = 0;        // counts
  std::uint64_t span_ = 0;        // from the first counter of this run to the newest
  std::bitset<window> received_;  // bit n: newest_ - 1 - n was received

  // For CounterUse::automatic.
  std::array<std::uint64_t, window> fingerprints_{};  // of the records of the last second, without duplicates
  std::size_t next_fingerprint_ = 0;
  unsigned repeats_ = 0, lates_ = 0;   // in a row
  std::uint64_t steady_ = 0;           // Order::next in a row
  std::uint64_t since_backward_jump_;  // records since note_backward_jump()

  SequenceCounts counts_;
};

}  // namespace trk_bridge::base
