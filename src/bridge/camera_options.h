// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Options of one camera.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// Where a stamp comes from; the delay is subtracted from it.
enum class StampMode : std::uint8_t {
  arrival,  ///< Sample::arrival
  counter,  ///< arrival without jitter, see CounterClock; Sample::arrival if the counter does not count
  source,   ///< Sample::sample_time; Sample::arrival if the record has none
};

/// Hz, used until the rate of a camera is known.
inline constexpr double assumed_field_rate = 50;

/// Options that can be changed while records are received. Trivially copyable.
struct LiveOptions {
  double delay = 0;  ///< s, subtracted from every stamp
  bool publish_tf = true;
  bool publish_camera_info = true;
};

struct CameraOptions : LiveOptions {
  /// None: records with any id belong to this camera; then its source must serve no other camera.
  std::optional<std::uint32_t> id;
  /// FormatBit mask of published parameters; none: the sender's format is kept.
  std::optional<std::uint32_t> format = wire::euler;
  StampMode stamp = StampMode::arrival;
  std::optional<wire::CameraConstants> constants;  ///< used until the sender's constants arrive
  base::CounterUse counter = base::CounterUse::automatic;
  double failover = 0.5;  ///< s of silence after which another sender is accepted; see SenderLock
  /// px, the largest error with which a CameraInfo uses the model plumb_bob; infinite: always.
  double plumb_bob_tolerance = camera::plumb_bob_tolerance;
};

}  // namespace trk_bridge::bridge
