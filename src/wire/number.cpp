// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace trk_bridge::wire {

namespace {

/// Removes a sign from the front; true for a minus.
bool take_sign(std::string_view& word) noexcept {
  if (word.empty() || (word.front() != '+' && word.front() != '-')) return false;
  const bool minus = word.front() == '-';
  word.remove_prefix(1);
  return minus;
}

/// All of `digits` must be digits of `base`, after a minus if T is signed.
template <class T>
NumberFault read_whole(std::string_view digits, T& value, int base) noexcept {
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, base);
  if (stop != end || error == std::errc::invalid_argument) return Reason::not_a_number;
  if (error == std::errc::result_out_of_range) return Reason::out_of_range;
  return std::nullopt;
}

/// Whether an unsigned decimal outside the range of doubles is too small. It is so far from 1 that the sign of its
/// decimal exponent is sufficient.
bool is_tiny(std::string_view word) noexcept {
  constexpr long cap = 1000000;
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const std::string_view mantissa = word.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t leading = std::min(mantissa.find_first_of("123456789"), mantissa.size());
  const long places = static_cast<long>(point) - static_cast<long>(leading);

  std::string_view power = word.substr(std::min(e + 1, word.size()));
  const bool minus = take_sign(power);
  long exponent = 0;
  for (const char c : power) exponent = std::min(cap, exponent * 10 + (c - '0'));
  return places + (minus ? -exponent : exponent) <= 0;
}

}  // namespace

NumberFault read_number(std::string_view word, double& value) noexcept {
  const bool minus = take_sign(word);
  if (word.empty() || word.front() == '-') return Reason::not_a_number;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value, std::chars_format::general);
  if (stop != end || error == std::errc::invalid_argument) return Reason::not_a_number;
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny(word)) return Reason::out_of_range;
    value = 0;
  } else if (!std::isfinite(value)) {
    return Reason::not_finite;
  }
  if (minus) value = -value;
  return std::nullopt;
}

NumberFault read_number(std::string_view word, std::int32_t& value) noexcept {
  const bool plus = !word.empty() && word.front() == '+';
  if (plus) word.remove_prefix(1);
  if (plus && !word.empty() && word.front() == '-') return Reason::not_a_number;
  return read_whole(word, value, 10);
}

NumberFault read_number(std::string_view word, std::uint64_t& value) noexcept {
  const bool minus = take_sign(word);
  const NumberFault fault = read_whole(word, value, 10);
  if (!fault && minus && value != 0) return Reason::out_of_range;
  return fault;
}

NumberFault read_digits(std::string_view word, std::uint32_t& value) noexcept { return read_whole(word, value, 10); }

NumberFault read_hexadecimal(std::string_view word, std::uint32_t& value) noexcept {
  if (word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X')) word.remove_prefix(2);
  return read_whole(word, value, 16);
}

}  // namespace trk_bridge::wire
