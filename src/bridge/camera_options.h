// What is to be made of one camera's records.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// What a stamp is made of, less the delay.
enum class StampMode : std::uint8_t {
  arrival,  ///< Sample::arrival
  counter,  ///< arrivals without jitter, see CounterClock; arrivals where the counter does not count
  source,   ///< Sample::sample_time; arrivals where the record has none
};

/// Hz, of a camera whose rate is not known yet.
inline constexpr double assumed_field_rate = 50;

/// What can be changed while records come. Trivially copyable.
struct LiveOptions {
  double delay = 0;  ///< s, taken off every stamp
  bool publish_tf = true;
  bool publish_camera_info = true;
};

struct CameraOptions : LiveOptions {
  /// None: records of every id are this camera's; then its source must serve this camera alone.
  std::optional<std::uint32_t> id;
  /// FormatBit mask of published parameters; none: they stay in the sender's format.
  std::optional<std::uint32_t> format = wire::euler;
  StampMode stamp = StampMode::arrival;
  std::optional<wire::CameraConstants> constants;  ///< until the sender's own ones come
  base::CounterUse counter = base::CounterUse::automatic;
  double failover = 0.5;  ///< s of silence after which another sender may follow; see SenderLock
  /// px, the error up to which a CameraInfo is of model plumb_bob; infinite: always.
  double plumb_bob_tolerance = camera::plumb_bob_tolerance;
};

}  // namespace trk_bridge::bridge
