// Parameters that have arrived and not been handed out, for trkNetBufReadParams (document, section 7.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::c_api {

/// Keeps up to 16 sets, each counter once, in the order of their counters. A set that comes late is put in its place
/// while it is still wanted; where counting restarts (base::Sequence, automatic), older sets go. Not synchronised,
/// never allocates.
class ParamsRing {
 public:
  static constexpr std::size_t capacity = 16;

  /// A full ring loses its oldest set.
  void push(const wire::CameraParams&) noexcept;
  std::size_t size() const noexcept { return size_; }

  /// None of these gives a set twice, or one that is older than one given before, but for a restart. None when nothing
  /// has arrived since.
  ///
  /// The newest, and none of what came before it.
  std::optional<wire::CameraParams> pop_newest() noexcept;
  std::optional<wire::CameraParams> pop_oldest() noexcept;
  /// The set `passed` counts after the one taken last, else the next one after it. The newest when the counter of the
  /// newest is more than `tolerated` past the wanted one, no set has the wanted counter or a later one, nothing was
  /// taken before, counting restarted, or the ring is full.
  std::optional<wire::CameraParams> pop_paced(std::uint64_t passed, std::uint64_t tolerated) noexcept;

 private:
  void begin_with(const wire::CameraParams&) noexcept;
  void insert(const wire::CameraParams&) noexcept;
  std::optional<wire::CameraParams> pop(std::size_t i) noexcept;

  base::Sequence sequence_{50.0, base::CounterUse::automatic};
  std::array<wire::CameraParams, capacity> sets_{};  // the oldest first
  std::size_t size_ = 0;
  std::uint64_t given_ = 0;            // the counter of the set taken last; valid while there is a last_
  std::optional<std::uint64_t> last_;  // the counter from which steps are counted; none after a restart
};

}  // namespace trk_bridge::c_api
