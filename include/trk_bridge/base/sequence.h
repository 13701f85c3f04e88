// What a counter says about the record that carries it: next, lost, late, twice, or a tracker that restarted.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>

namespace trk_bridge::base {

/// The verdict on one counter.
enum class Order : std::uint8_t {
  first,
  next,       ///< newer than all before; those missing between are counted as lost
  duplicate,  ///< a counter that came before, the newest one or a late one
  late,       ///< older than the newest: out of order
  restarted,  ///< back by more than a second's worth, or ahead by more than `restart_ahead`: a new count begins
};

/// Whether a record with this verdict is new and in order.
constexpr bool is_new(Order order) noexcept {
  return order == Order::first || order == Order::next || order == Order::restarted;
}

/// `accepted` counts the verdicts for which is_new() is true.
struct SequenceCounts {
  std::uint64_t accepted = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
};

/// Judges the counters of one camera. Not synchronised, never allocates.
///
/// A late record that had been counted as lost is taken off that count again, and so is not mistaken for a duplicate,
/// as far as `window` counts behind the newest; one older than that is late. A 4-byte counter that wraps goes on
/// (0xFFFFFFFF, 0 is next).
class Sequence {
 public:
  /// `field_rate` in Hz, more than 0 and at most 1e6: how many counts a second has. Throws std::invalid_argument.
  explicit Sequence(double field_rate = 50.0);

  /// Judges the next record's counter and counts the verdict.
  Order judge(std::uint64_t counter) noexcept;
  const SequenceCounts& counts() const noexcept { return counts_; }

  /// Seconds' worth of counts a jump ahead may have before it is a restart and not loss.
  static constexpr double restart_ahead = 60.0;
  /// Counts behind the newest that are remembered: a second of 240 Hz.
  static constexpr std::size_t window = 256;

 private:
  void begin_at(std::uint64_t counter) noexcept;
  Order judge_ahead(std::uint64_t counter, std::uint64_t by) noexcept;
  Order judge_back(std::uint64_t counter, std::uint64_t by) noexcept;

  std::uint64_t second_;         // counts
  std::uint64_t restart_ahead_;  // counts
  std::optional<std::uint64_t> newest_;
  std::uint64_t span_ = 0;    // from the first counter of this run to the newest
  std::bitset<window> came_;  // bit n: newest_ - 1 - n came
  SequenceCounts counts_;
};

}  // namespace trk_bridge::base
