// Numbers in memory images, in either byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "trk_bridge/wire/layout.h"

namespace trk_bridge::wire {

template <class Unsigned>
Unsigned load(const char* from, ByteOrder order) noexcept {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    const std::size_t at = order == ByteOrder::big ? i : sizeof(Unsigned) - 1 - i;
    value = static_cast<Unsigned>(value << 8 | static_cast<unsigned char>(from[at]));
  }
  return value;
}

template <class Unsigned>
void store(Unsigned value, char* to, ByteOrder order) noexcept {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    const std::size_t at = order == ByteOrder::little ? i : sizeof(Unsigned) - 1 - i;
    to[at] = static_cast<char>(static_cast<unsigned char>(value >> 8 * i));
  }
}

inline double load_double(const char* from, ByteOrder order) noexcept {
  const auto bits = load<std::uint64_t>(from, order);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline void store_double(double value, char* to, ByteOrder order) noexcept {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  store(bits, to, order);
}

}  // namespace trk_bridge::wire
