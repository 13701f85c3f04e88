// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace trk_bridge::cli {

/// With the fewest digits that read back to the same value.
template <typename Number>
std::string number_text(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace trk_bridge::cli
