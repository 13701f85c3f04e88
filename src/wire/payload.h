// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Encodes and decodes the payload that follows the header of a datagram: the functions of codec.h without a copy.
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {

/// The largest size of a payload after a header.
inline constexpr std::size_t payload_room = max_datagram - header_size;

/// Reads all fields of `into`. False: `fault` gives the reason, and `into` is unspecified. (To return a small
/// tl::expected takes longer than to read a binary record, because it is written by bytes and read as words.)
[[nodiscard]] bool read_text(std::string_view text, CameraParams& into, Fault& fault) noexcept;
[[nodiscard]] bool read_text(std::string_view text, CameraConstants& into, Fault& fault) noexcept;
[[nodiscard]] bool read_image(std::string_view image, const Layout&, CameraParams& into, Fault& fault) noexcept;
[[nodiscard]] bool read_image(std::string_view image, const Layout&, CameraConstants& into, Fault& fault) noexcept;

/// Writes up to `payload_room` bytes and returns their number. 0: `fault` gives the reason.
[[nodiscard]] std::size_t write_text(const CameraParams&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_text(const CameraParams&, char* to, Fault& fault, TextCache&) noexcept;
[[nodiscard]] std::size_t write_text(const CameraConstants&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_image(const CameraParams&, const Layout&, char* to, Fault& fault) noexcept;
[[nodiscard]] std::size_t write_image(const CameraConstants&, const Layout&, char* to, Fault& fault) noexcept;

/// Sets the part of the transform that the format does not select to zero.
inline void clear_unselected(CameraParams& p) noexcept {
  if (!has(p.format, euler)) {
    p.euler = {};
    return;
  }
  // Unrolled: otherwise the compiler uses a string instruction, which takes longer than all the rest of a record.
#pragma GCC unroll 16
  for (double& value : p.matrix) value = 0;
}

/// The record in `into`; if it has another type, it is replaced by one of this type.
template <class T>
T& record_in(Record& into) noexcept {
  if (!std::holds_alternative<T>(into)) into = Record(std::in_place_type<T>);
  return *std::get_if<T>(&into);
}

}  // namespace trk_bridge::wire
