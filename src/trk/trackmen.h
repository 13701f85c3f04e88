// The packet of the plugin of the protocol's present owner (doc/free_d.md, "TrackMen's packet"): read, never written.
#pragma once

#include <string_view>

#include <tl/expected.hpp>

#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::trk {

/// Whether the datagram begins with the packet's magic, which no datagram of trk does.
bool is_trackmen(std::string_view datagram) noexcept;

/// Euler angles and image distance, which is that of the packet's angle of view over the packet's chip, so that no
/// constants are needed; the id is 0. Places of fields in faults are those of ASCII records, 16 and 17 the chip's
/// sides.
[[nodiscard]] tl::expected<wire::CameraParams, wire::Fault> trackmen_params(std::string_view datagram) noexcept;

}  // namespace trk_bridge::trk
