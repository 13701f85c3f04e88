// Parameters that have arrived and not been handed out, for trkNetBufReadParams (document, section 7.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::c_api {

/// Keeps the newest 16 in order of arrival. Not synchronised, never allocates.
class ParamsRing {
 public:
  static constexpr std::size_t capacity = 16;

  void push(const wire::CameraParams&) noexcept;

  /// The newest, and none of what came before it. None when nothing has arrived since.
  std::optional<wire::CameraParams> pop_newest() noexcept;
  /// The set `passed` counts after the one taken last, else the next one after it. The newest when the counter of the
  /// newest is more than `tolerated` past the wanted one, no set has the wanted counter or a later one, nothing was
  /// taken before, counting restarted, counters do not ascend, or the ring is full. None when nothing has arrived
  /// since.
  std::optional<wire::CameraParams> pop_paced(std::uint64_t passed, std::uint64_t tolerated) noexcept;

 private:
  const wire::CameraParams& at(std::size_t i) const noexcept { return sets_[(first_ + i) % capacity]; }
  bool is_ascending() const noexcept;
  wire::CameraParams pop(std::size_t i) noexcept;

  std::array<wire::CameraParams, capacity> sets_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::optional<std::uint64_t> last_;
};

}  // namespace trk_bridge::c_api
