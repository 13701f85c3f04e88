// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/layout.h"

#include <array>

#include "layout_words.h"
#include "shape.h"

namespace trk_bridge::wire {

namespace {

template <class T, std::size_t n>
std::optional<T> find(const std::array<Named<T>, n>& all, std::string_view name) {
  for (const Named<T>& one : all) {
    if (one.name == name) return one.value;
  }
  return std::nullopt;
}

/// Removes the text up to and including the next '_' from `text`, and returns it without the '_'.
std::string_view take_part(std::string_view& text) {
  const std::size_t end = text.find('_');
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

}  // namespace

std::size_t params_size(Layout layout) noexcept { return params_shape(layout.generation, layout.abi).size; }

std::size_t constants_size(Layout layout) noexcept { return constants_shape(layout.generation, layout.abi).size; }

std::string describe(Layout layout) {
  return std::string(name_of(generations, layout.generation)) + ' ' + std::string(name_of(abis, layout.abi)) +
         (layout.byte_order == ByteOrder::little ? " little-endian" : " big-endian");
}

std::optional<LayoutChoice> layout_choice_from_word(std::string_view word) {
  LayoutChoice choice;
  if (word == "auto") return choice;
  std::string_view rest = word;
  choice.generation = find(generations, take_part(rest));
  bool known = choice.generation.has_value();
  if (known && !rest.empty()) {
    choice.abi = find(abis, take_part(rest));
    known = choice.abi.has_value();
  }
  if (known && !rest.empty()) {
    choice.byte_order = find(byte_orders, rest);
    known = choice.byte_order.has_value();
  }
  if (known && word.back() != '_') return choice;
  return std::nullopt;
}

Layout resolve(const LayoutChoice& choice, Layout fallback) noexcept {
  return {choice.generation.value_or(fallback.generation), choice.abi.value_or(fallback.abi),
          choice.byte_order.value_or(fallback.byte_order)};
}

}  // namespace trk_bridge::wire
