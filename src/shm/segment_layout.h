// Where things lie in shared memory segments (doc/wire_formats.md, "Shared memory"): one table for all that the field
// has.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::shm {

/// What every trk segment begins with, as the maker's unsigned long.
inline constexpr std::uint32_t segment_magic = 0x2357BD01;

/// Where things lie in a segment, in bytes from its beginning. The size identifies the layout.
struct SegmentLayout {
  std::size_t size;
  wire::Layout record;
  std::size_t magic_size;  ///< of an unsigned long
  std::size_t connected, params_counter, constants_counter;
  std::size_t params_size, constants_size;
  std::array<std::size_t, 2> params, constants;
};

/// What segments are made of where nobody says otherwise: every program of today can attach to it.
inline constexpr wire::Layout default_layout{
    wire::Generation::identified, wire::Abi::lp64,
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? wire::ByteOrder::little : wire::ByteOrder::big};

/// Two 32-bit words in the rest of the page behind a segment, which is mapped and shared like the segment and which no
/// program of the field knows. 0 in a new segment.
namespace page_rest {
/// announcement_mark and the counter of the parameters that were last written by a program that wakes readers.
inline constexpr std::size_t announcement = 1024;
/// A futex. Odd: somebody waits for the next write, which makes it even, another number than all before, and wakes.
inline constexpr std::size_t wake_word = 1028;
}  // namespace page_rest
inline constexpr std::uint32_t announcement_mark = 0x77610000;

/// Null when no segment has this size.
const SegmentLayout* layout_of_size(std::size_t) noexcept;
/// Null when no segment on this machine has this record layout.
const SegmentLayout* layout_of(wire::Layout) noexcept;
/// The layout of the other generation when its programs can attach to a segment of this one, which is larger; they find
/// the counters where it has them, and write records of their own. Null when there is none.
const SegmentLayout* smaller_generation(const SegmentLayout&) noexcept;

/// Where a current record lies, in a segment's own layout or in that of the other generation.
struct Range {
  std::size_t begin, end;
};
constexpr Range range_of(const std::array<std::size_t, 2>& own, std::size_t own_size,
                         const std::array<std::size_t, 2>& other, std::size_t other_size, std::size_t element) {
  return {std::min(own[element], other[element]), std::max(own[element] + own_size, other[element] + other_size)};
}
/// No such range is longer.
inline constexpr std::size_t record_room = 256;

}  // namespace trk_bridge::shm
