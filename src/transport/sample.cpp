// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/transport/sample.h"

#include <array>
#include <cstddef>
#include <string_view>

#include <arpa/inet.h>

#include "wire/layout_words.h"

namespace trk_bridge::transport {
namespace {

std::string address_text(int family, const Sender& sender) {
  char text[INET6_ADDRSTRLEN] = "";
  ::inet_ntop(family, sender.address.data(), text, sizeof text);
  return text;
}

std::string describe_wire(const Fault& fault) {
  wire::Fault of_wire{static_cast<wire::Reason>(fault.code())};
  of_wire.about_field = fault.field() >= 0;
  if (of_wire.about_field) of_wire.field = static_cast<std::uint8_t>(fault.field());
  return wire::describe(of_wire);
}

constexpr std::size_t index_of(const wire::Layout& layout, bool guessed) noexcept {
  std::size_t index = static_cast<std::size_t>(layout.generation);
  index = index * wire::abis.size() + static_cast<std::size_t>(layout.abi);
  index = index * wire::byte_orders.size() + static_cast<std::size_t>(layout.byte_order);
  return index * 2 + (guessed ? 1 : 0);
}

/// A text that ends with a NUL.
struct Text {
  std::array<char, 48> characters{};
  std::size_t size = 0;

  constexpr void add(std::string_view more) noexcept {
    for (const char c : more) characters[size++] = c;
  }
};

/// The layout as in `layout=…` of a URL.
constexpr Text text_of(const wire::Layout& layout, bool guessed) noexcept {
  Text text;
  text.add("binary ");
  text.add(name_of(wire::generations, layout.generation));
  text.add("_");
  text.add(name_of(wire::abis, layout.abi));
  if (layout.byte_order == wire::ByteOrder::big) text.add("_be");
  if (guessed) text.add(", layout guessed");
  return text;
}

using Texts = std::array<Text, wire::generations.size() * wire::abis.size() * wire::byte_orders.size() * 2>;

constexpr Texts all_texts() noexcept {
  Texts texts;
  for (const auto& generation : wire::generations) {
    for (const auto& abi : wire::abis) {
      for (const auto& order : wire::byte_orders) {
        for (const bool guessed : {false, true}) {
          const wire::Layout layout{generation.value, abi.value, order.value};
          texts[index_of(layout, guessed)] = text_of(layout, guessed);
        }
      }
    }
  }
  return texts;
}

// Created at compile time, so that the first sample does not allocate either.
constexpr Texts texts = all_texts();

}  // namespace

std::string to_string(const Sender& sender) {
  switch (sender.kind) {
    case SenderKind::none:
      return "-";
    case SenderKind::ipv4:
      return address_text(AF_INET, sender) + ":" + std::to_string(sender.number);
    case SenderKind::ipv6:
      return "[" + address_text(AF_INET6, sender) + "]:" + std::to_string(sender.number);
    case SenderKind::shm:
      return "slot " + std::to_string(sender.number);
    case SenderKind::file:
      return "file";
    case SenderKind::memory:
      return "memory";
  }
  return "-";
}

Fault::Fault(const wire::Fault& fault) noexcept
    : Fault(wire::name(fault.reason), describe_wire, static_cast<std::uint8_t>(fault.reason),
            fault.about_field ? std::int16_t{fault.field} : std::int16_t{-1}) {}

const char* origin_of(const wire::WireForm& form, bool layout_guessed) noexcept {
  if (form.encoding == wire::Encoding::ascii) return "ASCII";
  return texts[index_of(form.layout, layout_guessed)].characters.data();
}

}  // namespace trk_bridge::transport
