// Where the fields of a binary record lie: the memory image of the sender's struct (wire format, "Binary payload").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace trk_bridge::wire {

/// Whether records begin with an id.
enum class Generation : std::uint8_t { document, identified };

/// The sender's sizes and padding. llp64 stands for every ABI with 8-byte aligned doubles and a 4-byte long: 64-bit
/// and 32-bit Windows, IRIX o32/n32, 32-bit ARM.
enum class Abi : std::uint8_t { lp64, llp64, i386 };

enum class ByteOrder : std::uint8_t { little, big };

struct Layout {
  Generation generation = Generation::document;
  Abi abi = Abi::lp64;
  ByteOrder byte_order = ByteOrder::little;
};
constexpr bool operator==(Layout a, Layout b) noexcept {
  return a.generation == b.generation && a.abi == b.abi && a.byte_order == b.byte_order;
}
constexpr bool operator!=(Layout a, Layout b) noexcept { return !(a == b); }

/// Bytes of a binary record in this layout, header not counted.
std::size_t params_size(Layout) noexcept;
std::size_t constants_size(Layout) noexcept;

/// "identified lp64 little-endian".
std::string describe(Layout);

/// What the user said of a sender's layout; what is not said is found out.
struct LayoutChoice {
  std::optional<Generation> generation;
  std::optional<Abi> abi;
  std::optional<ByteOrder> byte_order;
};

/// `auto`, `document` or `identified`, the latter two optionally followed by `_lp64`, `_llp64` or `_i386` and that by
/// `_be` or `_le`. The error lists what is allowed.
tl::expected<LayoutChoice, std::string> layout_choice_from_word(std::string_view);

/// The layout to write where the user said `choice`: `fallback` for everything unsaid.
Layout resolve(const LayoutChoice&, Layout fallback) noexcept;

/// What is known of one sender's layout. One a sender: keep it between its datagrams. Not synchronised.
///
/// In order of weight: what was said outright; what the constants' size told (56: document; 64 or 60: identified; 4-byte
/// alignment at 60, and at 192/196-byte parameters); which reading is sound. A reading is sound when the format mask is
/// within known_format_bits, all numbers are finite, and, for a matrix, the bottom row is 0 0 0 1 and the rotation
/// orthonormal to 1e-3. When both generations are sound, the one seen last from the sender wins, else `identified` with
/// an id that looks like one (below 65536), which is what everything in use today speaks.
///
/// An 8-byte counter whose upper half is not zero is a 4-byte counter before padding, unless the layout was said
/// outright or the upper half was seen to go up by one as the lower one wrapped: a counter of one a field takes
/// more than 200 days at 240 Hz to get there, while padding may be anything.
class LayoutSense {
 public:
  LayoutSense() = default;
  explicit LayoutSense(const LayoutChoice& said) : said_(said) {}

  const LayoutChoice& said() const noexcept { return said_; }
  /// The layout of the last good binary record; none before one.
  std::optional<Layout> seen() const noexcept { return seen_; }

 private:
  friend struct LayoutSenseAccess;
  LayoutChoice said_;
  std::optional<Layout> seen_;
  std::optional<Generation> told_by_constants_;
  std::optional<std::uint64_t> last_raw_counter_;
  bool wide_counter_ = false;
};

}  // namespace trk_bridge::wire
