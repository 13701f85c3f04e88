// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What an input of ros_to_trk passes to every outlet.
#pragma once

#include <cstdint>
#include <optional>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// One set of parameters, preceded by the camera's constants if they or the id changed. Both have the same id.
struct OutgoingSet {
  std::optional<wire::CameraConstants> constants;
  wire::CameraParams params;
  std::int64_t time = 0;       ///< time of the parameters, ns since 1970 UTC; 0: unknown
  std::int64_t lens_time = 0;  ///< time of the lens; 0: same as `time`
};

}  // namespace trk_bridge::bridge
