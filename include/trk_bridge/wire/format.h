// The format mask of a parameter record and the document's words for it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::wire {

/// Format options (document, section "Camera Parameters"). A clear bit means the default named behind it.
enum FormatBit : std::uint32_t {
  euler = 0x001,             ///< else matrix
  studio_to_camera = 0x002,  ///< else camera_to_studio
  camera_y_up = 0x004,       ///< else camera_z_up
  studio_y_up = 0x008,       ///< else studio_z_up
  field_of_view = 0x010,     ///< else image_distance
  vertical = 0x020,          ///< else horizontal
  diagonal = 0x040,          ///< else horizontal; vertical wins when both are set
  ignore_blank = 0x080,      ///< else consider_blank
  keep_aspect = 0x100,       ///< else adjust_aspect
  shift_in_pixels = 0x200,   ///< else shift_on_chip
};

/// Every bit that has a meaning.
inline constexpr std::uint32_t known_format_bits = 0x3FF;

/// True when `mask` sets all of `bits`.
constexpr bool has(std::uint32_t mask, std::uint32_t bits) noexcept { return (mask & bits) == bits; }

/// The words that matter for `mask`, one space between, in the document's order: `euler` hides the matrix words,
/// `image_distance` the angle words, `consider_blank` the aspect words. Unknown bits have no word.
std::string format_to_words(std::uint32_t mask);

/// The mask that `words` name: any of the 19 words in any case and order, separated by any white space; empty is 0.
/// Of two opposite words the last one counts. The error names the word that is not known and lists those that are.
tl::expected<std::uint32_t, std::string> format_from_words(std::string_view words);

/// Whether a record may be *made* in this format: no unknown bits, not vertical and diagonal at once. (Records that
/// arrived in another format are read and passed on.)
constexpr bool is_writable(std::uint32_t mask) noexcept {
  return (mask & ~known_format_bits) == 0 && !has(mask, vertical | diagonal);
}
/// The same with an error that says what is wrong.
tl::expected<void, std::string> check_writable(std::uint32_t mask);

}  // namespace trk_bridge::wire
