#include <algorithm>

#include "shm_segment.h"

namespace trk_bridge::shm {
namespace {

constexpr wire::ByteOrder native_order =
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? wire::ByteOrder::little : wire::ByteOrder::big;

constexpr wire::Layout record(wire::Generation generation, wire::Abi abi) { return {generation, abi, native_order}; }

constexpr std::array<ShmLayout, 4> layouts{{
    {544, record(wire::Generation::identified, wire::Abi::lp64), 8, 8, 12, 14, 200, 64, {16, 216}, {416, 480}},
    {528, record(wire::Generation::document, wire::Abi::lp64), 8, 8, 12, 14, 200, 56, {16, 216}, {416, 472}},
    {524, record(wire::Generation::identified, wire::Abi::i386), 4, 4, 8, 10, 196, 60, {12, 208}, {404, 464}},
    {508, record(wire::Generation::document, wire::Abi::i386), 4, 4, 8, 10, 192, 56, {12, 204}, {396, 452}},
}};

// The header ends where the first record begins, records follow each other without a gap, and the copies go word by
// word.
constexpr bool is_tight(const ShmLayout& l) {
  return l.connected == l.magic_size && l.params_counter == l.connected + 4 &&
         l.constants_counter == l.params_counter + 2 && l.params[0] == l.constants_counter + 2 &&
         l.params[1] == l.params[0] + l.params_size && l.constants[0] == l.params[1] + l.params_size &&
         l.constants[1] == l.constants[0] + l.constants_size && l.size == l.constants[1] + l.constants_size &&
         l.params_size % 4 == 0 && l.constants_size % 4 == 0 && l.params[0] % 4 == 0 &&
         l.params_size <= sizeof(ShmImage::bytes);
}
static_assert(is_tight(layouts[0]) && is_tight(layouts[1]) && is_tight(layouts[2]) && is_tight(layouts[3]));

}  // namespace

const std::array<ShmLayout, 4>& shm_layouts() noexcept { return layouts; }

const ShmLayout* shm_layout_of_size(std::size_t size) noexcept {
  const auto found = std::find_if(layouts.begin(), layouts.end(), [&](const ShmLayout& l) { return l.size == size; });
  return found == layouts.end() ? nullptr : &*found;
}

const ShmLayout* shm_layout_of(wire::Layout record) noexcept {
  const auto found =
      std::find_if(layouts.begin(), layouts.end(), [&](const ShmLayout& l) { return l.record == record; });
  return found == layouts.end() ? nullptr : &*found;
}

}  // namespace trk_bridge::shm
