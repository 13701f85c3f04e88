// What an input of ros_to_trk gives to every outlet.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// One set of parameters, and before it the camera's constants where these are new or the id is another one. Both have
/// the same id.
struct OutgoingSet {
  std::optional<wire::CameraConstants> constants;
  wire::CameraParams params;
  std::int64_t time = 0;       ///< when they were true, ns since 1970 UTC; 0: unknown
  std::int64_t lens_time = 0;  ///< likewise of the lens; 0: as the rest
};

}  // namespace trk_bridge::bridge
