// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The format mask of a parameter record, and its words in the document.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::wire {

/// Format options (document, section "Camera Parameters"). A clear bit means the default given in the comment.
enum FormatBit : std::uint32_t {
  euler = 0x001,             ///< else matrix
  studio_to_camera = 0x002,  ///< else camera_to_studio
  camera_y_up = 0x004,       ///< else camera_z_up
  studio_y_up = 0x008,       ///< else studio_z_up
  field_of_view = 0x010,     ///< else image_distance
  vertical = 0x020,          ///< else horizontal
  diagonal = 0x040,          ///< else horizontal; if both are set, vertical is used
  ignore_blank = 0x080,      ///< else consider_blank
  keep_aspect = 0x100,       ///< else adjust_aspect
  shift_in_pixels = 0x200,   ///< else shift_on_chip
};

/// All bits that have a meaning.
inline constexpr std::uint32_t known_format_bits = 0x3FF;

/// True when `mask` sets all of `bits`.
constexpr bool has(std::uint32_t mask, std::uint32_t bits) noexcept { return (mask & bits) == bits; }

/// The words that are relevant for `mask`, separated by single spaces, in the order of the document: `euler` excludes
/// the matrix words, `image_distance` the angle words, `consider_blank` the aspect words. Unknown bits have no word.
std::string format_to_words(std::uint32_t mask);

/// The mask of `words`: any of the 19 words in any case and order, separated by white space; empty is 0. Of two
/// opposite words, the last one is used. The error names the unknown word and lists the known ones.
tl::expected<std::uint32_t, std::string> format_from_words(std::string_view words);

/// Whether a record may be written in this format: no unknown bits, and not both vertical and diagonal. (Received
/// records of other formats are read and forwarded.)
constexpr bool is_writable(std::uint32_t mask) noexcept {
  return (mask & ~known_format_bits) == 0 && !has(mask, vertical | diagonal);
}
/// The same with an error text.
tl::expected<void, std::string> check_writable(std::uint32_t mask);

}  // namespace trk_bridge::wire
