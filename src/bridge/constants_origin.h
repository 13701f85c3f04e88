// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The origin of the constants in use.
#pragma once

#include <cstdint>

namespace trk_bridge::bridge {

/// Later ones replace earlier ones.
enum class ConstantsOrigin : std::uint8_t {
  none,
  parameter,
  any_camera,  ///< received with id 0, valid for every camera of the source
  own,         ///< received with the camera's id, or with any id if the camera has none
};

}  // namespace trk_bridge::bridge
