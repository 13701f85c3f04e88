// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Numbers in memory, in either byte order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::wire {

inline constexpr ByteOrder native_order = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? ByteOrder::big : ByteOrder::little;

constexpr std::uint32_t swap_bytes(std::uint32_t value) noexcept { return __builtin_bswap32(value); }
constexpr std::uint64_t swap_bytes(std::uint64_t value) noexcept { return __builtin_bswap64(value); }

/// Reads a number of 4 or 8 bytes.
template <class Number>
Number load(const char* from, ByteOrder order) noexcept {
  std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t> bits;
  static_assert(sizeof bits == sizeof(Number));
  std::memcpy(&bits, from, sizeof bits);
  if (order != native_order) bits = swap_bytes(bits);
  Number value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Reads `n` consecutive doubles.
template <std::size_t n>
std::array<double, n> load_doubles(const char* from, ByteOrder order) noexcept {
  std::array<double, n> values;
  std::memcpy(values.data(), from, sizeof values);
  if (order == native_order) return values;
  for (std::size_t i = 0; i < n; ++i) values[i] = load<double>(from + i * sizeof(double), order);
  return values;
}

template <class Number>
void store(Number value, char* to, ByteOrder order) noexcept {
  std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t> bits;
  static_assert(sizeof bits == sizeof(Number));
  std::memcpy(&bits, &value, sizeof bits);
  if (order != native_order) bits = swap_bytes(bits);
  std::memcpy(to, &bits, sizeof bits);
}

template <std::size_t n>
void store_doubles(const std::array<double, n>& values, char* to, ByteOrder order) noexcept {
  if (order == native_order) {
    std::memcpy(to, values.data(), sizeof values);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) store(values[i], to + i * sizeof(double), order);
}

}  // namespace trk_bridge::wire
