// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Combines parameters and constants of two topics for outlets.
#pragma once

#include <cstdint>
#include <optional>

#include "constants_origin.h"
#include "outgoing_set.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::bridge {

/// Trivially copyable.
struct ParamsToTrkStatistics {
  std::uint64_t received = 0;       ///< parameters
  std::int64_t last_received = 0;   ///< steady clock, ns; valid once received > 0
  std::uint32_t last_format = 0;    ///< as received
  std::uint64_t bad_constants = 0;  ///< invalid constants (no picture is left): ignored
  ConstantsOrigin constants = ConstantsOrigin::none;
};

/// Not synchronised: one thread at a time. Does not allocate.
class ParamsToTrk {
 public:
  /// `constants` are used until others are received; they must have passed camera::check().
  explicit ParamsToTrk(const std::optional<wire::CameraConstants>& constants = std::nullopt) noexcept;

  /// Stores constants, which are sent with the next parameters. The newest valid ones are used, whatever their id.
  void use(const wire::CameraConstants&) noexcept;

  /// The parameters unchanged, with the constants if outlets need them. `now` is the steady clock, ns.
  OutgoingSet use(const wire::CameraParams&, std::int64_t now) noexcept;

  const ParamsToTrkStatistics& statistics() const noexcept { return statistics_; }

 private:
  std::optional<wire::CameraConstants> newest_;
  camera::Converter given_;  // knows what outlets have received
  ParamsToTrkStatistics statistics_;
};

}  // namespace trk_bridge::bridge
