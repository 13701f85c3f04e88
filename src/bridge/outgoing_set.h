// What an input of ros_to_trk gives to every outlet.
#pragma once

#include <optional>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// One set of parameters, and before it the camera's constants where these are new or the id is another one. Both have
/// the same id.
struct OutgoingSet {
  std::optional<wire::CameraConstants> constants;
  wire::CameraParams params;
};

}  // namespace trk_bridge::bridge
