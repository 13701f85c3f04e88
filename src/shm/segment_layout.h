// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The layouts of shared memory segments (doc/wire_formats.md, "Shared memory"): one table for all existing programs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::shm {

/// Every trk segment begins with this number, as an unsigned long of its creator.
inline constexpr std::uint32_t segment_magic = 0x2357BD01;

/// Offsets in a segment, in bytes from its beginning. The size identifies the layout.
struct SegmentLayout {
  std::size_t size;
  wire::Layout record;
  std::size_t magic_size;  ///< of an unsigned long
  std::size_t connected, params_counter, constants_counter;
  std::size_t params_size, constants_size;
  std::array<std::size_t, 2> params, constants;
};

/// The default layout of new segments: every program in use can attach to it.
inline constexpr wire::Layout default_layout{
    wire::Generation::identified, wire::Abi::lp64,
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? wire::ByteOrder::little : wire::ByteOrder::big};

/// Two 32-bit words in the rest of the page after a segment. It is mapped and shared like the segment, and existing
/// programs do not use it. 0 in a new segment.
namespace page_rest {
/// announcement_mark and the counter of the last parameters that were written by a program that wakes readers.
inline constexpr std::size_t announcement = 1024;
/// A futex. Odd: a reader waits for the next write. That write changes it to a new, even number and wakes the reader.
inline constexpr std::size_t wake_word = 1028;
}  // namespace page_rest
inline constexpr std::uint32_t announcement_mark = 0x77610000;

/// Null if no segment has this size.
const SegmentLayout* layout_of_size(std::size_t) noexcept;
/// Null if no segment on this machine has this record layout.
const SegmentLayout* layout_of(wire::Layout) noexcept;
/// The layout of the other generation, if it is smaller: then its programs can attach to a segment of this layout. They
/// find the counters at the same offsets and write records in their own layout. Null if there is none.
const SegmentLayout* smaller_generation(const SegmentLayout&) noexcept;

/// The bytes of a current record in the layout of a segment and in that of the other generation.
struct Range {
  std::size_t begin, end;
};
constexpr Range range_of(const std::array<std::size_t, 2>& own, std::size_t own_size,
                         const std::array<std::size_t, 2>& other, std::size_t other_size, std::size_t element) {
  return {std::min(own[element], other[element]), std::max(own[element] + own_size, other[element] + other_size)};
}
/// The largest size of such a range.
inline constexpr std::size_t record_room = 256;

}  // namespace trk_bridge::shm
