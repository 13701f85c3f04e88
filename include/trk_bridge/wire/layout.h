// Where the fields of a binary record lie: the memory image of the sender's struct (doc/wire_formats.md, "Binary").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trk_bridge::wire {

/// Whether records begin with an id.
enum class Generation : std::uint8_t { document, identified };

/// The sender's sizes and padding. llp64 stands for every ABI with 8-byte aligned doubles and a 4-byte long: 64-bit
/// and 32-bit Windows, IRIX o32/n32, 32-bit ARM.
enum class Abi : std::uint8_t { lp64, llp64, i386 };

/// Of the sender's machine.
enum class ByteOrder : std::uint8_t { little, big };

/// Everything that decides where a field lies.
struct Layout {
  Generation generation = Generation::document;
  Abi abi = Abi::lp64;
  ByteOrder byte_order = ByteOrder::little;
};
constexpr bool operator==(Layout a, Layout b) noexcept {
  return a.generation == b.generation && a.abi == b.abi && a.byte_order == b.byte_order;
}
constexpr bool operator!=(Layout a, Layout b) noexcept { return !(a == b); }

/// Bytes of binary parameters in this layout, header not counted.
std::size_t params_size(Layout) noexcept;
/// Bytes of binary constants in this layout, header not counted.
std::size_t constants_size(Layout) noexcept;

/// "identified lp64 little-endian".
std::string describe(Layout);

/// What the user gave of a sender's layout; the rest is detected.
struct LayoutChoice {
  std::optional<Generation> generation;
  std::optional<Abi> abi;
  std::optional<ByteOrder> byte_order;
};

/// `auto`, `document` or `identified`, the latter two optionally followed by `_lp64`, `_llp64` or `_i386` and that by
/// `_be` or `_le`. None for other words.
std::optional<LayoutChoice> layout_choice_from_word(std::string_view);

/// The layout to write: what the user gave in `choice`, and what `fallback` has for the rest.
Layout resolve(const LayoutChoice& choice, Layout fallback) noexcept;

/// Detects the layout of one sender. Use one for each sender and keep it between its datagrams. Not synchronised.
///
/// What the user gave is not checked: only layouts with it are read, and when the generation is given a record is taken
/// as it is; a size that none of them has is a layout_mismatch. The rest is detected from every record of the sender.
///
/// The size of constants decides the generation: 56 bytes document, 64 or 60 identified. So does the size of parameters
/// of 192 bytes (document) and 196 (identified). Parameters of 200 bytes are read in both generations and byte orders.
/// A reading *fits* when
/// - with a matrix, the bottom row is 0 0 0 1;
/// - with Euler angles, these and the lens values are 0 or of a magnitude between 1e-50 and 1e12 (focus and aperture
///   aside), and no rigid matrix (`is_rigid`) stands in their place.
/// Without one that fits: no_valid_layout. Of several that fit the choice is, in order of weight,
/// 1. the generation of the last constants, or, before constants, the one of the last record that only one generation
///    could read; ids and format masks have to be below 65536 for that;
/// 2. a format mask within known_format_bits and an id below 65536, one of the two being wrong, both being wrong;
/// 3. identified when the second word is not 0 (padding seldom looks like a mask) or the first below 16; else, a first
///    word of 16 or more before a 0, document: that is a format before its padding rather than a camera of so high a
///    number in the default format;
/// 4. the byte order seen last from the sender, else little-endian.
/// Choice 3 is a guess where both generations read well (`Decoded::layout_guessed`): a sender whose layout matters has
/// to send constants, or its user to give the layout. A first and second word of 0 mean the same in both generations
/// and are read as identified.
/// When the reading chosen has a number that is not finite, that is the fault; the next best is not tried.
///
/// Constants are read in the byte order in which all six picture sizes are below 65536, the four chip sizes are as the
/// numbers above, and of width and height both are 0 or neither (picture and chip alike); with none: no_valid_layout.
///
/// The counter of a 200-byte record: 8 bytes whose upper half is not zero (read in the sender's byte order; that half
/// is the first one of a big-endian record) are taken for a 4-byte counter before padding, and the sender for `llp64`.
/// A true 8-byte counter of one a field takes more than 200 days at 240 Hz to get there, while padding may be anything.
/// When the upper half is seen to go up by one as the lower one wraps, the sender is `lp64` for good. With the upper
/// half zero and nothing seen before, both mean the same and `lp64` is named; a big-endian 4-byte counter of 0 before
/// padding that is not zero is recognised only after a record whose counter is not 0. None of this is done when the
/// user gave the abi.
class LayoutDetector {
 public:
  LayoutDetector() = default;
  explicit LayoutDetector(const LayoutChoice& given) : given_(given) {}

  /// The layout of the last good binary record; none before one.
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
