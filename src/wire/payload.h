// Records <-> what follows the header of their datagrams: the functions of codec.h without a copy in between.
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {

/// Room that any payload leaves free behind a header.
inline constexpr std::size_t payload_room = max_datagram - header_size;

/// Reads all fields of `into`. False: `fault` says why, and `into` is any record. (A tl::expected of a few bytes takes
/// longer to return than a binary record to read: it is written by bytes and read as words.)
[[nodiscard]] bool read_text(std::string_view text, CameraParams& into, Fault& fault) noexcept;
[[nodiscard]] bool read_text(std::string_view text, CameraConstants& into, Fault& fault) noexcept;
[[nodiscard]] bool read_image(std::string_view image, const Layout&, CameraParams& into, Fault& fault) noexcept;
[[nodiscard]] bool read_image(std::string_view image, const Layout&, CameraConstants& into, Fault& fault) noexcept;

/// Write up to `payload_room` bytes and return how many. 0: `fault` says why.
[[nodiscard]] std::size_t write_text(const CameraParams&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_text(const CameraParams&, char* to, Fault& fault, TextCache&) noexcept;
[[nodiscard]] std::size_t write_text(const CameraConstants&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_image(const CameraParams&, const Layout&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_image(const CameraConstants&, const Layout&, char* to, Fault& fault) noexcept;

/// Makes what the format does not select of the transform zero.
inline void clear_unselected(CameraParams& p) noexcept {
  if (!has(p.format, euler)) {
    p.euler = {};
    return;
  }
  // Unrolled, the compiler does not make it a string instruction, which takes longer than a whole record.
#pragma GCC unroll 16
  for (double& value : p.matrix) value = 0;
}

/// The record in `into`, made one of this type where it is none.
template <class T>
T& record_in(Record& into) noexcept {
  if (!std::holds_alternative<T>(into)) into = Record(std::in_place_type<T>);
  return *std::get_if<T>(&into);
}

}  // namespace trk_bridge::wire
