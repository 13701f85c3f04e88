// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "segment_layout.h"

namespace trk_bridge::shm {
namespace {

constexpr wire::Layout record(wire::Generation generation, wire::Abi abi) {
  return {generation, abi, default_layout.byte_order};
}

constexpr std::array<SegmentLayout, 4> layouts{{
    {544, record(wire::Generation::identified, wire::Abi::lp64), 8, 8, 12, 14, 200, 64, {16, 216}, {416, 480}},
    {528, record(wire::Generation::document, wire::Abi::lp64), 8, 8, 12, 14, 200, 56, {16, 216}, {416, 472}},
    {524, record(wire::Generation::identified, wire::Abi::i386), 4, 4, 8, 10, 196, 60, {12, 208}, {404, 464}},
    {508, record(wire::Generation::document, wire::Abi::i386), 4, 4, 8, 10, 192, 56, {12, 204}, {396, 452}},
}};

// The first record follows the header, there are no gaps between records, and all offsets are multiples of a word.
constexpr bool is_tight(const SegmentLayout& l) {
  return l.connected == l.magic_size && l.params_counter == l.connected + 4 &&
         l.constants_counter == l.params_counter + 2 && l.params[0] == l.constants_counter + 2 &&
         l.params[1] == l.params[0] + l.params_size && l.constants[0] == l.params[1] + l.params_size &&
         l.constants[1] == l.constants[0] + l.constants_size && l.size == l.constants[1] + l.constants_size &&
         l.params_size % 4 == 0 && l.constants_size % 4 == 0 && l.params[0] % 4 == 0;
}
static_assert(page_rest::announcement >= layouts[0].size, "the first is the largest");
static_assert(is_tight(layouts[0]) && is_tight(layouts[1]) && is_tight(layouts[2]) && is_tight(layouts[3]));

constexpr bool fit_together(const SegmentLayout& l, const SegmentLayout& smaller) {
  for (const std::size_t element : {0U, 1U}) {
    const Range params = range_of(l.params, l.params_size, smaller.params, smaller.params_size, element);
    const Range constants = range_of(l.constants, l.constants_size, smaller.constants, smaller.constants_size, element);
    if (params.end - params.begin > record_room || constants.end - constants.begin > record_room) return false;
  }
  return l.magic_size == smaller.magic_size && l.params_counter == smaller.params_counter && l.size > smaller.size;
}
static_assert(fit_together(layouts[0], layouts[1]) && fit_together(layouts[2], layouts[3]));

}  // namespace

const SegmentLayout* layout_of_size(std::size_t size) noexcept {
  const auto found =
      std::find_if(layouts.begin(), layouts.end(), [&](const SegmentLayout& l) { return l.size == size; });
  return found == layouts.end() ? nullptr : &*found;
}

const SegmentLayout* layout_of(wire::Layout record) noexcept {
  const auto found =
      std::find_if(layouts.begin(), layouts.end(), [&](const SegmentLayout& l) { return l.record == record; });
  return found == layouts.end() ? nullptr : &*found;
}

const SegmentLayout* smaller_generation(const SegmentLayout& layout) noexcept {
  const auto found = std::find_if(layouts.begin(), layouts.end(), [&](const SegmentLayout& l) {
    return l.size < layout.size && l.record.abi == layout.record.abi;
  });
  return found == layouts.end() ? nullptr : &*found;
}

}  // namespace trk_bridge::shm
