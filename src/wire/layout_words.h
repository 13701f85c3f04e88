// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// All values of the parts of a layout, with their words in `layout=…` of a URL.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::wire {

template <class T>
struct Named {
  std::string_view name;
  T value;
};

inline constexpr std::array<Named<Generation>, 2> generations{
    {{"document", Generation::document}, {"identified", Generation::identified}}};
inline constexpr std::array<Named<Abi>, 3> abis{{{"lp64", Abi::lp64}, {"llp64", Abi::llp64}, {"i386", Abi::i386}}};
inline constexpr std::array<Named<ByteOrder>, 2> byte_orders{{{"le", ByteOrder::little}, {"be", ByteOrder::big}}};

template <class T, std::size_t n>
constexpr std::string_view name_of(const std::array<Named<T>, n>& all, T value) noexcept {
  for (const Named<T>& one : all) {
    if (one.value == value) return one.name;
  }
  return "?";
}

/// Whether each value is the index of its entry, so that tables can be indexed by value.
template <class T, std::size_t n>
constexpr bool is_in_order(const std::array<Named<T>, n>& all) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    if (static_cast<std::size_t>(all[i].value) != i) return false;
  }
  return true;
}
static_assert(is_in_order(generations) && is_in_order(abis) && is_in_order(byte_orders));

}  // namespace trk_bridge::wire
