// Doubles to the shortest text that reads back, byte for byte as std::to_chars writes them.
#pragma once

#include <cstddef>

namespace trk_bridge::wire {

/// The longest is -2.2250738585072014e-308.
inline constexpr std::size_t longest_number = 24;
/// Bytes behind the text that write_shortest() may write to.
inline constexpr std::size_t number_room = longest_number + 8;

/// The text of a finite number; `to` has `number_room`. Returns the end of the text.
[[nodiscard]] char* write_shortest(double value, char* to) noexcept;

}  // namespace trk_bridge::wire
