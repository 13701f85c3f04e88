// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A queue of received parameters, for trkNetBufReadParams (document, section 7.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::c_api {

/// Holds up to 16 sets, each counter once, in the order of their counters. A late set is inserted in order if no later
/// one was taken yet. If the counter restarts (base::Sequence, automatic), older sets are dropped. Not synchronised,
/// never allocates.
class ParamsRing {
 public:
  static constexpr std::size_t capacity = 16;

  /// If the ring is full, the oldest set is dropped.
  void push(const wire::CameraParams&) noexcept;
  std::size_t size() const noexcept { return size_; }

  /// These never return a set twice, nor one that is older than a set returned before, except after a restart. None if
  /// nothing has arrived since.
  ///
  /// Takes the newest set and drops all older ones.
  std::optional<wire::CameraParams> pop_newest() noexcept;
  std::optional<wire::CameraParams> pop_oldest() noexcept;
  /// Takes the set `passed` counts after the one taken last, else the next one after that. Takes the newest set if its
  /// counter is more than `tolerated` past the wanted one, if no set has the wanted counter or a later one, if nothing
  /// was taken before, if the counter restarted, or if the ring is full.
  std::optional<wire::CameraParams> pop_paced(std::uint64_t passed, std::uint64_t tolerated) noexcept;

 private:
  void begin_with(const wire::CameraParams&) noexcept;
  void insert(const wire::CameraParams&) noexcept;
  std::optional<wire::CameraParams> pop(std::size_t i) noexcept;

  base::Sequence sequence_{50.0, base::CounterUse::automatic};
  std::array<wire::CameraParams, capacity> sets_{};  // oldest first
  std::size_t size_ = 0;
  std::uint64_t given_ = 0;            // counter of the set taken last; valid if last_ has a value
  std::optional<std::uint64_t> last_;  // the counter from which steps are counted; none after a restart
};

}  // namespace trk_bridge::c_api
