// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Properties that hold for any bytes that the codec decodes. The fuzz target and the tests check the same ones.
#pragma once

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test {

inline bool all_finite(const wire::CameraParams& p) {
  double sum = 0;
  if (wire::has(p.format, wire::euler)) {
    for (const double v : {p.euler.x, p.euler.y, p.euler.z, p.euler.pan, p.euler.tilt, p.euler.roll}) sum += v * 0;
  } else {
    for (const double v : p.matrix) sum += v * 0;
  }
  for (const double v : {p.fov, p.center_x, p.center_y, p.k1, p.k2, p.focdist, p.aperture}) sum += v * 0;
  return sum == 0;
}

inline bool all_finite(const wire::CameraConstants& c) {
  double sum = 0;
  for (const double v : {c.chip_width, c.chip_height, c.fake_chip_width, c.fake_chip_height}) sum += v * 0;
  return sum == 0;
}

/// `record` written in `form` and read again with that layout given; none if either fails.
template <class Record>
std::optional<Record> round_trip(const Record& record, wire::WireForm form) {
  wire::Buffer buffer;
  const auto bytes = wire::encode(record, form, buffer);
  if (!bytes) return std::nullopt;
  wire::LayoutDetector given({form.layout.generation, form.layout.abi, form.layout.byte_order});
  const auto read = wire::decode(*bytes, given);
  if (!read || !std::holds_alternative<Record>(read->record)) return std::nullopt;
  return std::get<Record>(read->record);
}

/// Text does not carry the bottom row of a matrix.
inline bool text_carries(const wire::CameraParams& p) {
  return wire::has(p.format, wire::euler) ||
         (p.matrix[3] == 0 && p.matrix[7] == 0 && p.matrix[11] == 0 && p.matrix[15] == 1);
}
inline bool text_carries(const wire::CameraConstants&) { return true; }

template <class Record>
std::string broken_claim_of(const Record& record, wire::WireForm form) {
  if (!all_finite(record)) return "a number is not finite";
  if (round_trip(record, form) != record) return "not the same after writing and reading it again";
  if (text_carries(record) && round_trip(record, {wire::Encoding::ascii, {}}) != record) {
    return "not the same through text";
  }
  const wire::Layout widest{wire::Generation::identified, wire::Abi::lp64, wire::ByteOrder::big};
  if (round_trip(record, {wire::Encoding::binary, widest}) != record) return "not the same through binary";
  return {};
}

/// Decodes `datagram` and returns the property that does not hold; empty if all hold, also if it is not a record.
inline std::string broken_claim(std::string_view datagram, wire::LayoutDetector& detector) {
  const auto before = detector.seen();
  const auto read = wire::decode(datagram, detector);
  if (!read) {
    if (wire::describe(read.error()).empty()) return "a fault without a description";
    if (detector.seen() != before) return "a fault taught a layout";
    return {};
  }
  if (datagram.size() > wire::max_datagram) return "a record longer than any datagram";
  if (read->form.encoding == wire::Encoding::binary) {
    const std::size_t size = std::holds_alternative<wire::CameraParams>(read->record)
                                 ? wire::params_size(read->form.layout)
                                 : wire::constants_size(read->form.layout);
    if (datagram.size() != wire::header_size + size) return "a layout of another size";
    if (detector.seen() != read->form.layout) return "the layout was not remembered";
  }
  return std::visit([&read](const auto& record) { return broken_claim_of(record, read->form); }, read->record);
}

}  // namespace trk_bridge::test
