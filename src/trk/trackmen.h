// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The packet of the plugin by the present owner of the protocol (doc/free_d.md, "TrackMen's packet"): read, never
// written.
#pragma once

#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::trk {

/// Whether the datagram begins with the packet's magic, which no datagram of trk does.
bool is_trackmen(std::string_view datagram) noexcept;

/// Returns Euler angles and the image distance, computed from the angle of view and the chip in the packet, so that no
/// constants are needed; the id is 0. Field numbers in faults are those of ASCII records; 16 and 17 are the sides of
/// the chip.
[[nodiscard]] tl::expected<wire::CameraParams, wire::Fault> trackmen_params(std::string_view datagram) noexcept;

}  // namespace trk_bridge::trk
