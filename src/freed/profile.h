// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The meaning of zoom, focus and the spare bytes, which Free-D does not define.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "message.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::freed {

enum class Profile : std::uint8_t {
  generic,  ///< zoom and focus are encoder counts, the spare bytes are unknown
  sony,     ///< counts; spare: iris in the lower 12 bits, a frame number in the upper 4
  zcam,     ///< zoom: focal length, 1/100 mm; focus: distance, 1/10 mm; spare: 100 * F-number, and a frame number
  vizrt,    ///< counts, with 524288 for zero
  mosys,    ///< counts; spare: quality of tracking
};

std::optional<Profile> profile_of(std::string_view word) noexcept;
inline constexpr std::string_view profiles_allowed = "generic, sony, zcam, vizrt and mosys";

/// Whether zoom and focus are lengths, and not counts that need a lens table.
constexpr bool sends_lens(Profile profile) noexcept { return profile == Profile::zcam; }

/// The encoder counts; unknown ones are empty.
transport::LensEncoders encoders_of(const Message&, Profile) noexcept;
/// The lens of a message whose profile sends_lens(). None if zoom is 0, which means unknown.
std::optional<camera::Lens> lens_of(const Message&) noexcept;

/// Writes the counts of zoom and focus. The error names the one that does not fit.
[[nodiscard]] tl::expected<void, transport::Fault> set_encoders(const transport::LensEncoders&, Profile,
                                                                Message&) noexcept;
/// Writes a lens, for profiles that sends_lens().
[[nodiscard]] tl::expected<void, transport::Fault> set_lens(const camera::Lens&, Message&) noexcept;
/// Writes the frame number, of which profiles have at most 4 bits.
void set_frame(std::uint64_t frame, Profile, Message&) noexcept;

}  // namespace trk_bridge::freed
