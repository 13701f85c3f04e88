// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The places of fields: their numbers in faults.
#pragma once

#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::wire {

/// Rows of a matrix in text; the fourth is 0 0 0 1.
inline constexpr std::size_t text_rows = 3;

inline constexpr std::size_t id_place = 0;
inline constexpr std::size_t format_place = 1;
inline constexpr std::size_t transform_place = 2;
inline constexpr std::size_t image_place = 1;
inline constexpr std::size_t chip_place = 7;

/// Id, format and counter are not lens fields.
inline constexpr std::size_t lens_fields = field_count<CameraParams>() - 3;

constexpr std::size_t lens_place(std::uint32_t format) noexcept {
  return transform_place + (has(format, euler) ? field_count<Euler>() : 4 * text_rows);
}
constexpr std::size_t counter_place(std::uint32_t format) noexcept { return lens_place(format) + lens_fields; }
static_assert(counter_place(euler) == 15 && counter_place(0) == 21, "fields of the ASCII records");

/// Place of `matrix[index]`. The bottom row is not in the text; it uses the place of the element above it.
constexpr std::size_t matrix_place(std::size_t index) noexcept {
  const std::size_t row = index % 4 < text_rows ? index % 4 : text_rows - 1;
  return transform_place + text_rows * (index / 4) + row;
}

constexpr Fault about_field(Reason reason, std::size_t place) noexcept {
  return Fault{reason, static_cast<std::uint8_t>(place), true};
}

/// Keeps the first of several faults, which is the one that is reported.
class FirstFault {
 public:
  explicit operator bool() const noexcept { return noted_; }
  const Fault& operator*() const noexcept { return fault_; }
  void note(Fault fault) noexcept {
    if (noted_) return;
    fault_ = fault;
    noted_ = true;
  }

 private:
  Fault fault_{Reason::truncated};
  bool noted_ = false;
};

}  // namespace trk_bridge::wire
