// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The list of the fields of the records: names, units, and the members that hold them. It exists only here.
//
// The functions for_each_... call `visit(field, member...)` for each field in the order of the ASCII records, with that
// member of each of `records`. The records may be of any types with members of these names: one record to read or write
// it, two to compare them, a record and a message to convert one to the other. A type without such a member does not
// compile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::wire {

/// Names and unit of one field.
struct Field {
  const char* name;           ///< in records, messages and parameters
  const char* document_name;  ///< in the document's C structures
  const char* unit;           ///< "m", "px", ...; empty for a plain number
  /// The format option that changes the unit to `unit_with_option`; 0 if the unit is always the same.
  std::uint32_t option = 0;
  const char* unit_with_option = "";

  /// The unit in records of this format.
  constexpr const char* unit_in(std::uint32_t format) const noexcept {
    return option != 0 && has(format, option) ? unit_with_option : unit;
  }
};

/// Position and angles, all double. For messages and C structures, pass the member that has x, y, z, pan, tilt and
/// roll.
template <class Visit, class... Poses>
constexpr void for_each_euler_field(Visit&& visit, Poses&... e) {
  visit(Field{"x", "x", "m"}, e.x...);
  visit(Field{"y", "y", "m"}, e.y...);
  visit(Field{"z", "z", "m"}, e.z...);
  visit(Field{"pan", "pan", "deg"}, e.pan...);
  visit(Field{"tilt", "tilt", "deg"}, e.tilt...);
  visit(Field{"roll", "roll", "deg"}, e.roll...);
}

/// The parameters between the transform and the counter, all double.
template <class Visit, class... Params>
constexpr void for_each_lens_field(Visit&& visit, Params&... p) {
  visit(Field{"fov", "fov", "mm", field_of_view, "deg"}, p.fov...);
  visit(Field{"center_x", "centerX", "mm", shift_in_pixels, "px"}, p.center_x...);
  visit(Field{"center_y", "centerY", "mm", shift_in_pixels, "px"}, p.center_y...);
  visit(Field{"k1", "k1", "mm^-2"}, p.k1...);
  visit(Field{"k2", "k2", "mm^-4"}, p.k2...);
  visit(Field{"focdist", "focdist", "m"}, p.focdist...);
  visit(Field{"aperture", "aperture", ""}, p.aperture...);
}

/// All parameters except the transform, which is either `matrix`, an array, or `euler`, which has its own fields.
template <class Visit, class... Params>
constexpr void for_each_params_field(Visit&& visit, Params&... p) {
  visit(Field{"id", "id", ""}, p.id...);
  visit(Field{"format", "format", ""}, p.format...);
  for_each_lens_field(visit, p...);
  visit(Field{"counter", "counter", ""}, p.counter...);
}

/// The image and its blanks, all std::int32_t.
template <class Visit, class... Constants>
constexpr void for_each_image_field(Visit&& visit, Constants&... c) {
  visit(Field{"image_width", "imageWidth", "px"}, c.image_width...);
  visit(Field{"image_height", "imageHeight", "px"}, c.image_height...);
  visit(Field{"blank_left", "blankLeft", "px"}, c.blank_left...);
  visit(Field{"blank_right", "blankRight", "px"}, c.blank_right...);
  visit(Field{"blank_top", "blankTop", "px"}, c.blank_top...);
  visit(Field{"blank_bottom", "blankBottom", "px"}, c.blank_bottom...);
}

/// The chip and the fake chip, all double.
template <class Visit, class... Constants>
constexpr void for_each_chip_field(Visit&& visit, Constants&... c) {
  visit(Field{"chip_width", "chipWidth", "mm"}, c.chip_width...);
  visit(Field{"chip_height", "chipHeight", "mm"}, c.chip_height...);
  visit(Field{"fake_chip_width", "fakeChipWidth", "mm"}, c.fake_chip_width...);
  visit(Field{"fake_chip_height", "fakeChipHeight", "mm"}, c.fake_chip_height...);
}

/// All constants.
template <class Visit, class... Constants>
constexpr void for_each_constants_field(Visit&& visit, Constants&... c) {
  visit(Field{"id", "id", ""}, c.id...);
  for_each_image_field(visit, c...);
  for_each_chip_field(visit, c...);
}

/// The fields of a Record: CameraParams, CameraConstants or Euler.
template <class Record, class Visit, class... Records>
constexpr void for_each_field(Visit&& visit, Records&... records) {
  if constexpr (std::is_same_v<Record, CameraParams>) {
    for_each_params_field(visit, records...);
  } else if constexpr (std::is_same_v<Record, CameraConstants>) {
    for_each_constants_field(visit, records...);
  } else {
    static_assert(std::is_same_v<Record, Euler>, "only CameraParams, CameraConstants and Euler have a list of fields");
    for_each_euler_field(visit, records...);
  }
}

/// Number of fields that for_each_field<Record>() visits.
template <class Record>
constexpr std::size_t field_count() noexcept {
  std::size_t count = 0;
  const Record record{};
  for_each_field<Record>([&count](const Field&, const auto&) { ++count; }, record);
  return count;
}

/// Copies the fields of a Record from `from` to `to`.
template <class Record, class From, class To>
constexpr void copy_fields(const From& from, To& to) noexcept {
  const auto copy = [](const Field&, const auto& value, auto& into) {
    into = static_cast<std::decay_t<decltype(into)>>(value);
  };
  for_each_field<Record>(copy, from, to);
}

/// Whether all fields of a Record have the same values in both.
template <class Record>
constexpr bool same_fields(const Record& a, const Record& b) noexcept {
  bool same = true;
  const auto compare = [&same](const Field&, const auto& of_a, const auto& of_b) { same = same && of_a == of_b; };
  for_each_field<Record>(compare, a, b);
  return same;
}

/// Equal for equal parameters and almost never for others: a 64-bit FNV-1a hash, one number at a time.
inline std::uint64_t fingerprint(const CameraParams& params) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&hash](const Field&, const auto& number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof number);
    hash = (hash ^ bits) * 0x100000001b3U;
    hash ^= hash >> 32U;
  };
  if (has(params.format, euler)) {
    for_each_euler_field(add, params.euler);
  } else {
    for (const double& number : params.matrix) add({}, number);
  }
  for_each_params_field(add, params);
  return hash;
}

}  // namespace trk_bridge::wire
