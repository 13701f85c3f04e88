// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trackmen.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/format.h"
#include "wire/bytes.h"
#include "wire/places.h"

namespace trk_bridge::trk {
namespace {

using wire::ByteOrder;
using wire::Fault;
using wire::Reason;

// All little-endian. The four bytes after the magic are unknown.
constexpr std::uint32_t magic = 0x544D4531;
constexpr std::size_t counter_at = 8, numbers_at = 12, numbers = 14, size = 124;
static_assert(numbers_at + numbers * sizeof(double) == size);

}  // namespace

bool is_trackmen(std::string_view datagram) noexcept {
  return datagram.size() >= sizeof magic && wire::load<std::uint32_t>(datagram.data(), ByteOrder::little) == magic;
}

tl::expected<wire::CameraParams, Fault> trackmen_params(std::string_view datagram) noexcept {
  if (datagram.size() != size) return tl::make_unexpected(Fault{Reason::wrong_size});
  wire::CameraParams p;
  p.format = wire::euler;
  p.counter = wire::load<std::uint32_t>(datagram.data() + counter_at, ByteOrder::little);
  double field_of_view = 0, chip_width = 0, chip_height = 0;
  double* const all[numbers] = {&p.euler.x,    &p.euler.y,     &p.euler.z,  &p.euler.pan, &p.euler.tilt,
                                &p.euler.roll, &field_of_view, &p.center_x, &p.center_y,  &p.k1,
                                &p.k2,         &p.focdist,     &chip_width, &chip_height};
  // The fields are those of a record with Euler angles, without aperture and counter.
  std::size_t place = wire::transform_place;
  for (std::size_t i = 0; i < numbers; ++i, ++place) {
    *all[i] = wire::load<double>(datagram.data() + numbers_at + i * sizeof(double), ByteOrder::little);
    if (all[i] == &chip_width) place = 16;
    if (!std::isfinite(*all[i])) return tl::make_unexpected(wire::about_field(Reason::not_finite, place));
  }
  const bool is_angle = field_of_view > 0 && field_of_view < 180;
  if (!is_angle) return tl::make_unexpected(wire::about_field(Reason::out_of_range, wire::lens_place(wire::euler)));
  if (!(chip_width > 0)) return tl::make_unexpected(wire::about_field(Reason::out_of_range, 16));
  p.fov = chip_width / 2 / std::tan(field_of_view * M_PI / 360);
  if (!std::isfinite(p.fov)) return tl::make_unexpected(wire::about_field(Reason::out_of_range, 16));
  return p;
}

}  // namespace trk_bridge::trk
