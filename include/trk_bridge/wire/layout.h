// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The layout of a binary record, which is the memory image of a struct of the sender (doc/wire_formats.md, "Binary").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trk_bridge::wire {

/// Whether records begin with an id.
enum class Generation : std::uint8_t { document, identified };

/// Sizes and padding on the machine of the sender. llp64 stands for every ABI with 8-byte aligned doubles and a 4-byte
/// long: 64-bit and 32-bit Windows, IRIX o32/n32, 32-bit ARM.
enum class Abi : std::uint8_t { lp64, llp64, i386 };

/// Byte order on the machine of the sender.
enum class ByteOrder : std::uint8_t { little, big };

/// Everything that determines the offset of a field.
struct Layout {
  Generation generation = Generation::document;
  Abi abi = Abi::lp64;
  ByteOrder byte_order = ByteOrder::little;
};
constexpr bool operator==(Layout a, Layout b) noexcept {
  return a.generation == b.generation && a.abi == b.abi && a.byte_order == b.byte_order;
}
constexpr bool operator!=(Layout a, Layout b) noexcept { return !(a == b); }

/// Bytes of binary parameters in this layout, without the header.
std::size_t params_size(Layout) noexcept;
/// Bytes of binary constants in this layout, without the header.
std::size_t constants_size(Layout) noexcept;

/// "identified lp64 little-endian".
std::string describe(Layout);

/// The parts of the layout that the user has given; the rest is detected.
struct LayoutChoice {
  std::optional<Generation> generation;
  std::optional<Abi> abi;
  std::optional<ByteOrder> byte_order;
};

/// `auto`, `document` or `identified`; the latter two may be followed by `_lp64`, `_llp64` or `_i386`, and then by
/// `_be` or `_le`. None for other words.
std::optional<LayoutChoice> layout_choice_from_word(std::string_view);

/// The layout to write: the parts given in `choice`, and `fallback` for the rest.
Layout resolve(const LayoutChoice& choice, Layout fallback) noexcept;

/// Detects the layout of one sender. Use one object per sender and keep it between its datagrams. Not synchronised.
///
/// What the user has given is not checked: only layouts that match it are tried, and if the generation is given, a
/// record is accepted as it is. A size that none of these layouts has is a layout_mismatch. The rest is detected from
/// every record of the sender.
///
/// The size of constants determines the generation: 56 bytes for document, 64 or 60 for identified. Parameters of 192
/// bytes are of the generation document, those of 196 bytes are identified. Parameters of 200 bytes are tried in both
/// generations and byte orders. A candidate *fits* if
/// - with a matrix, the bottom row is 0 0 0 1;
/// - with Euler angles, these and the lens values are 0 or of a magnitude between 1e-50 and 1e12 (except focus and
///   aperture), and the same bytes are not a rigid matrix (`is_rigid`).
/// If none fits: no_valid_layout. Of several that fit, one is selected by these criteria, the most important first:
/// 1. the generation of the last constants; before any constants, that of the last record that was valid in one
///    generation only; for this, ids and format masks must be below 65536;
/// 2. a format mask within known_format_bits and an id below 65536; then records with one of the two wrong; then with
///    both wrong;
/// 3. identified if the second word is not 0 (padding seldom looks like a mask) or the first is below 16; otherwise
///    document: a first word of 16 or more followed by 0 is more probably a format with its padding than the id of a
///    camera with the default format;
/// 4. the last byte order of the sender, else little-endian.
/// Criterion 3 is a guess if the record is valid in both generations (`Decoded::layout_guessed`): to avoid it, the
/// sender must send constants, or the user must give the layout. If the first and second word are 0, they mean the same
/// in both generations and are read as identified.
/// If the selected candidate has a number that is not finite, this is the fault; the next best is not tried.
///
/// Constants are read in the byte order in which all six image sizes are below 65536, the four chip sizes are in the
/// range above, and width and height are both 0 or both not 0 (of the image and of the chip). If there is none:
/// no_valid_layout.
///
/// The counter of a 200-byte record: if the upper half of its 8 bytes is not zero (in the byte order of the sender; in
/// a big-endian record, the first half), it is read as a 4-byte counter followed by padding, and the sender is `llp64`.
/// An 8-byte counter that counts fields reaches this value only after more than 200 days at 240 Hz, while padding may
/// have any value. If the upper half increases by one when the lower half wraps, the sender is `lp64` from then on. If
/// the upper half is zero and nothing else is known, both mean the same and `lp64` is reported. A big-endian 4-byte
/// counter of 0 followed by padding that is not zero is recognised only after a record whose counter is not 0. None of
/// this is done if the user has given the abi.
class LayoutDetector {
 public:
  LayoutDetector() = default;
  explicit LayoutDetector(const LayoutChoice& given) : given_(given) {}

  /// The layout of the last valid binary record; none before the first.
  std::optional<Layout> seen() const noexcept { return seen_; }

 private:
  friend struct LayoutDetectorAccess;
  LayoutChoice given_;
  std::optional<Layout> seen_;
  std::optional<Generation> generation_of_constants_;
  std::optional<Generation> only_possible_generation_;
  std::optional<std::uint64_t> last_wide_counter_;
  std::optional<Abi> counter_abi_;
};

}  // namespace trk_bridge::wire
