// The fields of the records in the order of the document, and their places: the numbers by which faults name them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/fault.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::wire {

/// Pointers to x, y, z, pan, tilt, roll.
template <class Params>
auto euler_of(Params& p) noexcept {
  return std::array{&p.euler.x, &p.euler.y, &p.euler.z, &p.euler.pan, &p.euler.tilt, &p.euler.roll};
}

/// Pointers to the numbers between the transform and the counter.
template <class Params>
auto lens_of(Params& p) noexcept {
  return std::array{&p.fov, &p.center_x, &p.center_y, &p.k1, &p.k2, &p.focdist, &p.aperture};
}

template <class Constants>
auto pixels_of(Constants& c) noexcept {
  return std::array{&c.image_width, &c.image_height, &c.blank_left, &c.blank_right, &c.blank_top, &c.blank_bottom};
}

template <class Constants>
auto sizes_of(Constants& c) noexcept {
  return std::array{&c.chip_width, &c.chip_height, &c.fake_chip_width, &c.fake_chip_height};
}

/// Rows of a matrix that text carries; the fourth is 0 0 0 1.
inline constexpr std::size_t text_rows = 3;

inline constexpr std::size_t id_place = 0;
inline constexpr std::size_t format_place = 1;
inline constexpr std::size_t transform_place = 2;
inline constexpr std::size_t pixels_place = 1;
inline constexpr std::size_t sizes_place = 7;

constexpr std::size_t lens_place(std::uint32_t format) noexcept {
  return transform_place + (has(format, euler) ? 6 : 4 * text_rows);
}
constexpr std::size_t counter_place(std::uint32_t format) noexcept { return lens_place(format) + 7; }
static_assert(counter_place(euler) == 15 && counter_place(0) == 21, "fields of the ASCII records");

/// Place of `matrix[index]`. The bottom row has none in the text and takes that of the element above it.
constexpr std::size_t matrix_place(std::size_t index) noexcept {
  const std::size_t row = index % 4 < text_rows ? index % 4 : text_rows - 1;
  return transform_place + text_rows * (index / 4) + row;
}

constexpr Fault about_field(Reason reason, std::size_t place) noexcept {
  return Fault{reason, static_cast<std::uint8_t>(place), true};
}

/// The first of the faults noted, for a record is refused for one.
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
