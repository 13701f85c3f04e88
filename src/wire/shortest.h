// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The shortest text of a double that reads back to the same value, byte for byte as from std::to_chars.
#pragma once

#include <cstddef>

namespace trk_bridge::wire {

/// Length of -2.2250738585072014e-308.
inline constexpr std::size_t longest_number = 24;
/// Size of the buffer for write_shortest(), which may write beyond the end of the text.
inline constexpr std::size_t number_room = longest_number + 8;

/// Writes the text of a finite number; `to` has `number_room` bytes. Returns the end of the text.
[[nodiscard]] char* write_shortest(double value, char* to) noexcept;

}  // namespace trk_bridge::wire
