// What zoom, focus and the spare bytes mean, which Free-D leaves to the sender.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "message.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::freed {

enum class Profile : std::uint8_t {
  generic,  ///< zoom and focus are counts of encoders, the spare bytes are unknown
  sony,     ///< likewise; spare: iris in the lower 12 bits, a frame number in the upper 4
  zcam,     ///< zoom: focal length, 1/100 mm; focus: distance, 1/10 mm; spare: 100 * F-number, and a frame number
  vizrt,    ///< counts with 524288 for zero
  mosys,    ///< counts; spare: quality of tracking
};

std::optional<Profile> profile_of(std::string_view word) noexcept;
inline constexpr std::string_view profiles_allowed = "generic, sony, zcam, vizrt and mosys";

/// Whether zoom and focus are lengths, and not counts that only a lens table gives a meaning.
constexpr bool tells_lens(Profile profile) noexcept { return profile == Profile::zcam; }

/// The counts of the encoders; what is not known is not there.
transport::LensEncoders encoders_of(const Message&, Profile) noexcept;
/// The lens of a message whose profile tells_lens(). None where it says 0: not known.
std::optional<camera::Lens> lens_of(const Message&) noexcept;

/// Writes counts of zoom and focus. The error names the one that does not fit.
[[nodiscard]] tl::expected<void, transport::Fault> set_encoders(const transport::LensEncoders&, Profile,
                                                                Message&) noexcept;
/// Writes a lens where the profile tells_lens().
[[nodiscard]] tl::expected<void, transport::Fault> set_lens(const camera::Lens&, Message&) noexcept;
/// Writes the number of the frame, of which profiles have at most 4 bits.
void set_frame(std::uint64_t frame, Profile, Message&) noexcept;

}  // namespace trk_bridge::freed
