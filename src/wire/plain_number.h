// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads common forms of numbers from a text in one pass; number.h reads all others.
#pragma once

#include <cfloat>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fast_float/fast_float.h>

#include "bytes.h"
#include "decimal.h"
#include "words.h"

namespace trk_bridge::wire {

constexpr bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

/// More digits may not fit into 64 bits.
inline constexpr std::ptrdiff_t most_plain_digits = 19;

/// Appends the digits at `at` to those of `number`, which is invalid if there are too many. Returns the position after
/// them.
inline const char* take_digits(const char* at, const char* end, std::uint64_t& number) noexcept {
  constexpr std::size_t width = 8;
  while (end - at >= static_cast<std::ptrdiff_t>(width)) {
    const std::uint64_t bytes = load<std::uint64_t>(at, ByteOrder::little) ^ 0x3030303030303030U;
    // Has the high bit of the first byte that is not a digit; the high bits of later bytes may be wrong.
    const std::uint64_t others = (bytes | (bytes + 0x7676767676767676U)) & 0x8080808080808080U;
    const std::size_t count = others == 0 ? width : static_cast<std::size_t>(__builtin_ctzll(others)) / width;
    if (count == 0) return at;
    // Pads with leading zeros, then combines neighbouring numbers three times.
    std::uint64_t digits = bytes << (8 * (width - count));
    digits = (digits * 10 + (digits >> 8U)) & 0x00FF00FF00FF00FFU;
    digits = (digits * 100 + (digits >> 16U)) & 0x0000FFFF0000FFFFU;
    digits = (digits * 10000 + (digits >> 32U)) & 0x00000000FFFFFFFFU;
    number = number * powers_of_ten[count] + digits;
    at += count;
    if (count < width) return at;
  }
  for (; at != end && is_digit(*at); ++at) number = number * 10 + static_cast<unsigned>(*at - '0');
  return at;
}

/// digits * 10^exponent, rounded to the nearest; false if it is outside the range of doubles.
inline bool scale(std::uint64_t digits, int exponent, double& value) noexcept {
  const auto nearest = fast_float::compute_float<fast_float::binary_format<double>>(exponent, digits);
  constexpr int beyond = 0x7FF;
  if (nearest.power2 < 0 || nearest.power2 >= beyond) return false;
  const std::uint64_t bits = nearest.mantissa | static_cast<std::uint64_t>(nearest.power2) << 52U;
  std::memcpy(&value, &bits, sizeof value);
  return true;
}

/// Whether digits * 10^exponent is one operation of two exact doubles, and so rounded once.
constexpr bool is_exact(std::uint64_t digits, int exponent) noexcept {
  constexpr int largest = static_cast<int>(exact_powers_of_ten.size()) - 1;
  constexpr bool doubles_are_evaluated_as_such = FLT_EVAL_METHOD == 0;
  return doubles_are_evaluated_as_such && digits <= std::uint64_t{1} << 53U && exponent >= -largest &&
         exponent <= largest;
}

/// The number of leading zeros from `begin` to `end`, which may have a point.
inline std::ptrdiff_t leading_zeros(const char* begin, const char* end) noexcept {
  std::ptrdiff_t zeros = 0;
  for (; begin != end && (*begin == '0' || *begin == '.'); ++begin) zeros += *begin == '0' ? 1 : 0;
  return zeros;
}

/// Reads the number at `at`, a word that must be followed by white space before `end`. Returns the position of that
/// white space; null if the word is not plain: more digits than `most_plain_digits`, a plus, an exponent of more than
/// four digits, or not a number.
inline const char* read_plain_number(const char* at, const char* end, double& value) noexcept {
  const bool minus = *at == '-';
  if (minus) ++at;
  std::uint64_t digits = 0;
  const char* const whole = at;
  for (; is_digit(*at); ++at) digits = digits * 10 + static_cast<unsigned>(*at - '0');
  std::ptrdiff_t count = at - whole;
  int exponent = 0;
  if (*at == '.') {
    const char* const fraction = ++at;
    at = take_digits(at, end, digits);
    count += at - fraction;
    exponent = static_cast<int>(fraction - at);
  }
  if (count == 0) return nullptr;
  if (count > most_plain_digits && count - leading_zeros(whole, at) > most_plain_digits) return nullptr;
  if (*at == 'e' || *at == 'E') {
    ++at;
    const bool is_negative = *at == '-';
    if (*at == '-' || *at == '+') ++at;
    const char* const power = at;
    int given = 0;
    for (; is_digit(*at) && at - power < 4; ++at) given = given * 10 + (*at - '0');
    if (at == power) return nullptr;
    exponent += is_negative ? -given : given;
  }
  if (!is_space(*at)) return nullptr;
  if (is_exact(digits, exponent)) {
    const auto whole_number = static_cast<double>(digits);
    value = exponent < 0 ? whole_number / exact_powers_of_ten[static_cast<std::size_t>(-exponent)]
                         : whole_number * exact_powers_of_ten[static_cast<std::size_t>(exponent)];
  } else if (!scale(digits, exponent, value)) {
    return nullptr;
  }
  if (minus) value = -value;
  return at;
}

/// Reads up to `most_plain_digits` digits; null if the word at `at` is anything else.
inline const char* read_plain_number(const char* at, const char* end, std::uint64_t& value) noexcept {
  value = 0;
  const char* const after = take_digits(at, end, value);
  const bool is_whole_word = after != at && (after == end || is_space(*after));
  return is_whole_word && after - at <= most_plain_digits ? after : nullptr;
}

}  // namespace trk_bridge::wire
