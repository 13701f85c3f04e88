// Sizes and offsets of the binary records (doc/wire_formats.md, "Binary"), and their numbers in either byte order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::wire {

struct ParamsShape {
  std::size_t format, transform, lens, counter, counter_width, size;
};

struct ConstantsShape {
  std::size_t image, chip, size;
};

inline constexpr std::size_t transform_size = 128;
/// Identified records begin with their id.
inline constexpr std::size_t id_offset = 0;

constexpr ParamsShape params_shape(Generation generation, Abi abi) noexcept {
  ParamsShape s{};
  s.format = generation == Generation::identified ? 4 : 0;
  s.transform = abi == Abi::i386 ? s.format + 4 : 8;
  s.lens = s.transform + transform_size;
  s.counter = s.lens + 7 * sizeof(double);
  s.counter_width = abi == Abi::lp64 ? 8 : 4;
  s.size = s.counter + (abi == Abi::i386 ? 4 : 8);
  return s;
}

constexpr ConstantsShape constants_shape(Generation generation, Abi abi) noexcept {
  ConstantsShape s{};
  s.image = generation == Generation::identified ? 4 : 0;
  s.chip = generation == Generation::identified && abi != Abi::i386 ? 32 : s.image + 24;
  s.size = s.chip + 4 * sizeof(double);
  return s;
}

static_assert(sizeof(double) == 8, "the records hold IEEE doubles");
static_assert(params_shape(Generation::document, Abi::lp64).size == 200);
static_assert(params_shape(Generation::document, Abi::llp64).size == 200);
static_assert(params_shape(Generation::document, Abi::i386).size == 192);
static_assert(params_shape(Generation::identified, Abi::lp64).size == 200);
static_assert(params_shape(Generation::identified, Abi::llp64).size == 200);
static_assert(params_shape(Generation::identified, Abi::i386).size == 196);
static_assert(params_shape(Generation::document, Abi::lp64).lens == 136);
static_assert(params_shape(Generation::document, Abi::lp64).counter == 192);
static_assert(params_shape(Generation::document, Abi::i386).transform == 4);
static_assert(params_shape(Generation::document, Abi::i386).counter == 188);
static_assert(params_shape(Generation::identified, Abi::i386).transform == 8);
static_assert(params_shape(Generation::identified, Abi::i386).counter == 192);
static_assert(constants_shape(Generation::document, Abi::lp64).size == 56);
static_assert(constants_shape(Generation::document, Abi::i386).size == 56);
static_assert(constants_shape(Generation::document, Abi::lp64).chip == 24);
static_assert(constants_shape(Generation::identified, Abi::lp64).size == 64);
static_assert(constants_shape(Generation::identified, Abi::llp64).chip == 32);
static_assert(constants_shape(Generation::identified, Abi::i386).size == 60);
static_assert(constants_shape(Generation::identified, Abi::i386).chip == 28);

constexpr ByteOrder native_order = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? ByteOrder::big : ByteOrder::little;

constexpr std::uint32_t swap_bytes(std::uint32_t value) noexcept { return __builtin_bswap32(value); }
constexpr std::uint64_t swap_bytes(std::uint64_t value) noexcept { return __builtin_bswap64(value); }

/// A number of 4 or 8 bytes.
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

/// `n` doubles, one behind another.
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
