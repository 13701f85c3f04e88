// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "bytes.h"
#include "payload.h"
#include "places.h"
#include "shape.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::wire {

namespace {

/// Calls visit(place, number) for every double that the format uses.
template <class Visit>
void for_each_number(const CameraParams& p, Visit&& visit) noexcept {
  const auto from = [&visit](std::size_t place) {
    return [&visit, place](const Field&, const double& value) mutable { visit(place++, value); };
  };
  if (has(p.format, euler)) {
    for_each_euler_field(from(transform_place), p.euler);
  } else {
#pragma GCC unroll 16
    for (std::size_t i = 0; i < 16; ++i) visit(matrix_place(i), p.matrix[i]);
  }
  for_each_lens_field(from(lens_place(p.format)), p);
}

template <class Visit>
void for_each_number(const CameraConstants& c, Visit&& visit) noexcept {
  std::size_t place = chip_place;
  for_each_chip_field([&visit, &place](const Field&, const double& value) { visit(place++, value); }, c);
}

template <class Record>
bool is_finite(const Record& record) noexcept {
  // An exponent of all ones carries into bit 63 when its lowest bit is added.
  constexpr std::uint64_t exponent = 0x7FF0'0000'0000'0000, lowest = 0x0010'0000'0000'0000;
  std::uint64_t carried = 0;
  for_each_number(record, [&carried](std::size_t, double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    carried |= (bits & exponent) + lowest;
  });
  return carried >> 63U == 0;
}

/// The fault of the first number that is not finite.
template <class Record>
Fault not_finite(const Record& record) noexcept {
  FirstFault fault;
  for_each_number(record, [&fault](std::size_t place, double value) {
    if (!std::isfinite(value)) fault.note(about_field(Reason::not_finite, place));
  });
  return *fault;
}

/// A visitor that reads consecutive fields; `at` is the first.
template <ByteOrder order>
auto load_from(const char* at) noexcept {
  return [next = at](const Field&, auto& value) mutable {
    value = load<std::decay_t<decltype(value)>>(next, order);
    next += sizeof value;
  };
}

/// A visitor that writes consecutive fields; `at` is the first.
template <ByteOrder order>
auto store_to(char* at) noexcept {
  return [next = at](const Field&, auto value) mutable {
    store(value, next, order);
    next += sizeof value;
  };
}

template <ByteOrder order>
void load_record(const char* image, const Layout& layout, CameraParams& p) noexcept {
  const ParamsShape shape = params_shape(layout.generation, layout.abi);
  p.id = layout.generation == Generation::identified ? load<std::uint32_t>(image + id_offset, order) : 0;
  p.format = load<std::uint32_t>(image + shape.format, order);
  clear_unselected(p);
  if (has(p.format, euler)) {
    for_each_euler_field(load_from<order>(image + shape.transform), p.euler);
  } else {
    p.matrix = load_doubles<16>(image + shape.transform, order);
  }
  for_each_lens_field(load_from<order>(image + shape.lens), p);
  p.counter = shape.counter_width == 8 ? load<std::uint64_t>(image + shape.counter, order)
                                       : load<std::uint32_t>(image + shape.counter, order);
}

template <ByteOrder order>
void load_record(const char* image, const Layout& layout, CameraConstants& c) noexcept {
  const ConstantsShape shape = constants_shape(layout.generation, layout.abi);
  c.id = layout.generation == Generation::identified ? load<std::uint32_t>(image + id_offset, order) : 0;
  for_each_image_field(load_from<order>(image + shape.image), c);
  for_each_chip_field(load_from<order>(image + shape.chip), c);
}

/// Writes an image completely, with zeros between the fields.
template <ByteOrder order>
void store_record(const CameraParams& p, const Layout& layout, char* image) noexcept {
  const ParamsShape shape = params_shape(layout.generation, layout.abi);
  const auto zero = [image](std::size_t begin, std::size_t end) {
    if (begin != end) std::memset(image + begin, 0, end - begin);
  };
  if (layout.generation == Generation::identified) store(p.id, image + id_offset, order);
  store(p.format, image + shape.format, order);
  zero(shape.format + sizeof p.format, shape.transform);
  if (has(p.format, euler)) {
    for_each_euler_field(store_to<order>(image + shape.transform), p.euler);
    zero(shape.transform + sizeof p.euler, shape.lens);
  } else {
    store_doubles(p.matrix, image + shape.transform, order);
  }
  for_each_lens_field(store_to<order>(image + shape.lens), p);
  if (shape.counter_width == 8) {
    store(p.counter, image + shape.counter, order);
  } else {
    store(static_cast<std::uint32_t>(p.counter), image + shape.counter, order);
  }
  zero(shape.counter + shape.counter_width, shape.size);
}

template <ByteOrder order>
void store_record(const CameraConstants& c, const Layout& layout, char* image) noexcept {
  const ConstantsShape shape = constants_shape(layout.generation, layout.abi);
  std::memset(image, 0, shape.chip);
  if (layout.generation == Generation::identified) store(c.id, image + id_offset, order);
  for_each_image_field(store_to<order>(image + shape.image), c);
  for_each_chip_field(store_to<order>(image + shape.chip), c);
}

std::size_t size_of(const CameraParams&, const Layout& layout) noexcept {
  return params_shape(layout.generation, layout.abi).size;
}
std::size_t size_of(const CameraConstants&, const Layout& layout) noexcept {
  return constants_shape(layout.generation, layout.abi).size;
}

/// Whether the layout can hold the counter of the record.
bool counter_fits(const CameraParams& p, const Layout& layout) noexcept {
  return params_shape(layout.generation, layout.abi).counter_width == 8 ||
         p.counter <= std::numeric_limits<std::uint32_t>::max();
}

template <class Record>
bool read(std::string_view image, const Layout& layout, Record& into, Fault& fault) noexcept {
  if (image.size() != size_of(into, layout)) {
    fault = {Reason::wrong_size};
    return false;
  }
  if (layout.byte_order == ByteOrder::little) {
    load_record<ByteOrder::little>(image.data(), layout, into);
  } else {
    load_record<ByteOrder::big>(image.data(), layout, into);
  }
  if (is_finite(into)) return true;
  fault = not_finite(into);
  return false;
}

template <class Record>
std::size_t write(const Record& record, const Layout& layout, char* to, Fault& fault) noexcept {
  if (!is_finite(record)) {
    fault = not_finite(record);
    return 0;
  }
  if constexpr (std::is_same_v<Record, CameraParams>) {
    if (!counter_fits(record, layout)) {
      fault = about_field(Reason::out_of_range, counter_place(record.format));
      return 0;
    }
  }
  const std::size_t size = size_of(record, layout);
  if (layout.byte_order == ByteOrder::little) {
    store_record<ByteOrder::little>(record, layout, to);
  } else {
    store_record<ByteOrder::big>(record, layout, to);
  }
  return size;
}

}  // namespace

bool read_image(std::string_view image, const Layout& layout, CameraParams& into, Fault& fault) noexcept {
  return read(image, layout, into, fault);
}
bool read_image(std::string_view image, const Layout& layout, CameraConstants& into, Fault& fault) noexcept {
  return read(image, layout, into, fault);
}
std::size_t write_image(const CameraParams& p, const Layout& layout, char* to, Fault& fault) noexcept {
  return write(p, layout, to, fault);
}
std::size_t write_image(const CameraConstants& c, const Layout& layout, char* to, Fault& fault) noexcept {
  return write(c, layout, to, fault);
}

}  // namespace trk_bridge::wire
