// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, with a decimal point in every locale, also in programs that call setlocale() or
// std::locale::global().
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

namespace trk_bridge::base {

/// With the fewest digits that read back to the same value.
template <typename Number>
std::string number_text(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// With `decimals` digits after the point, as printf's %.*f.
inline std::string fixed_text(double value, int decimals) {
  std::array<char, 512> text{};  // the largest double has 309 digits before the point
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr};
}

/// With at most `digits` significant digits, as printf's %.*g. A stream writes 6.
inline std::string general_text(double value, int digits = 6) {
  std::array<char, 64> text{};
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

}  // namespace trk_bridge::base
