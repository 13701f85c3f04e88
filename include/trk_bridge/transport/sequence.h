// What a counter says about the record that carries it: next, lost, late, twice, or a tracker started anew.
#pragma once

#include <cstdint>
#include <optional>

namespace trk_bridge::transport {

enum class Order : std::uint8_t {
  first,
  next,  ///< newer than all before; `lost` says how many are missing between
  duplicate,  ///< the counter of the newest one again
  late,  ///< older than the newest: out of order
  restarted,  ///< back by more than a second's worth, or ahead by more than `restart_ahead`: a new count begins
};

/// Whether a record with this verdict is news.
constexpr bool is_news(Order order) noexcept {
  return order == Order::first || order == Order::next || order == Order::restarted;
}

struct SequenceCounts {
  std::uint64_t accepted = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
};

/// Judges the counters of one camera. Not synchronised, never allocates.
///
/// A late record that had been counted as lost is taken off that count again. A 4-byte counter that wraps goes on
/// (0xFFFFFFFF, 0 is next).
class Sequence {
 public:
  /// `field_rate` in Hz, more than 0: how many counts a second has.
  explicit Sequence(double field_rate = 50.0);

  Order judge(std::uint64_t counter) noexcept;
  const SequenceCounts& counts() const noexcept { return counts_; }

  /// Seconds' worth of counts a jump ahead may have before it is a restart and not loss.
  static constexpr double restart_ahead = 60.0;

 private:
  std::uint64_t second_;
  std::optional<std::uint64_t> newest_;
  std::uint64_t seen_window_ = 0;  // bit n: newest_ - 1 - n came
  SequenceCounts counts_;
};

}  // namespace trk_bridge::transport
