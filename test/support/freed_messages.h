// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Messages of Free-D as bytes, and properties that hold for any bytes.
#pragma once

#include <cmath>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "freed/decoder.h"
#include "freed/message.h"

namespace trk_bridge::test {

inline std::string bytes(std::initializer_list<int> values) {
  std::string all;
  for (const int value : values) all += static_cast<char>(value);
  return all;
}

/// Numbers of every kind, calculated by hand:
///   camera 7
///   pan    30 degrees      * 32768 =  983040 = 0x0F0000
///   tilt   -5.5 degrees    * 32768 = -180224 = -0x2C000, 0x1000000 - 0x02C000 = 0xFD4000
///   roll   0.25 degrees    * 32768 =    8192 = 0x002000
///   x      1500 mm         * 64    =   96000 = 0x017700
///   y      -2000.5 mm      * 64    = -128032 = -0x1F420, 0x1000000 - 0x01F420 = 0xFE0BE0
///   height 1750 mm         * 64    =  112000 = 0x01B580
///   zoom 0x012345 = 74565, focus 0x0ABCDE = 703710, spare 0x1118
/// The sum of the 28 bytes is 0x811, the checksum (0x40 - 0x11) mod 256 = 0x2F.
inline std::string worked_message() {
  return bytes({0xD1, 0x07, 0x0F, 0x00, 0x00, 0xFD, 0x40, 0x00, 0x00, 0x20, 0x00, 0x01, 0x77, 0x00, 0xFE,
                0x0B, 0xE0, 0x01, 0xB5, 0x80, 0x01, 0x23, 0x45, 0x0A, 0xBC, 0xDE, 0x11, 0x18, 0x2F});
}

/// The limits of the ranges, calculated by hand:
///   camera 255
///   pan    -180 degrees * 32768 = -5898240 = -0x5A0000, 0x1000000 - 0x5A0000 = 0xA60000
///   tilt   90 degrees   * 32768 =  2949120 = 0x2D0000
///   roll   -256 degrees * 32768 = -8388608 = -0x800000, which is 0x800000
///   x      -131072 mm   * 64    = -8388608, 0x800000
///   y      0x7FFFFF = 8388607, / 64 = 131071.984375 mm
///   height -1/64 mm, 0xFFFFFF
///   zoom 0xFFFFFF = 16777215, focus 0, spare 0
/// The sum of the 28 bytes is 0xC1A, the checksum 0x40 - 0x1A = 0x26.
inline std::string extreme_message() {
  return bytes({0xD1, 0xFF, 0xA6, 0x00, 0x00, 0x2D, 0x00, 0x00, 0x80, 0x00, 0x00, 0x80, 0x00, 0x00, 0x7F,
                0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0x00, 0x00, 0x00, 0x26});
}

/// With pan, tilt and roll as they are in Free-D, in degrees.
inline std::string message_of(double pan, double tilt = 0, double roll = 0, std::uint8_t camera = 1) {
  freed::Message message;
  message.camera = camera;
  message.pan = static_cast<std::int32_t>(std::lround(pan * 32768));
  message.tilt = static_cast<std::int32_t>(std::lround(tilt * 32768));
  message.roll = static_cast<std::int32_t>(std::lround(roll * 32768));
  const auto all = freed::bytes_of(message);
  return {all.data(), all.size()};
}

inline std::shared_ptr<const lens::Table> table_of(const std::string& yaml) {
  auto table = lens::Table::from_yaml(yaml, "lens.yaml");
  if (!table) throw std::runtime_error(table.error());
  return std::make_shared<const lens::Table>(*std::move(table));
}

/// Decodes `datagram` and returns the property that does not hold; empty if all hold, also if it is not a message.
inline std::string broken_freed_claim(std::string_view datagram, freed::DecoderOptions options) {
  const bool lenient = options.lenient, has_table = options.table != nullptr;
  freed::Decoder decoder(std::move(options));
  decoder.begin(datagram, {});
  transport::Sample sample;
  transport::Fault fault;
  int params = 0, faults = 0;
  for (int calls = 0;; ++calls) {
    if (calls > 3) return "no end";
    const auto next = decoder.next(sample, fault);
    if (next == transport::Decoder::Next::none) break;
    if (next == transport::Decoder::Next::fault) {
      ++faults;
      if (describe(fault).empty()) return "a fault without a description";
    } else if (const auto* p = std::get_if<wire::CameraParams>(&sample.record)) {
      ++params;
      const auto& e = p->euler;
      for (const double angle : {e.pan, e.tilt, e.roll}) {
        if (!(std::abs(angle) <= 256)) return "an angle beyond 256 degrees";
      }
      for (const double position : {e.x, e.y, e.z}) {
        if (!(std::abs(position) <= 131.072)) return "a position beyond 131.072 m";
      }
      if (sample.has_lens && !(p->fov > 0 && std::isfinite(p->fov))) return "a lens without an image distance";
      if (sample.has_counter) return "a counter";
    } else if (!has_table) {
      return "constants of nowhere";
    }
  }
  if (params + faults != 1) return "neither one record nor one fault";
  if (params == 0) return {};
  const auto read = freed::read(datagram);
  if (!read) return "a record of bytes that are no message";
  const auto again = freed::bytes_of(read->message);
  if (std::string_view(again.data(), 28) != datagram.substr(0, 28)) return "other bytes when written again";
  const bool same_checksum = again.back() == datagram.back();
  if (same_checksum != read->checksum_fits) return "a wrong result for a checksum";
  if (!same_checksum && (!lenient || std::string_view(sample.doubt) != "wrong checksum")) {
    return "a wrong checksum without a word";
  }
  return {};
}

}  // namespace trk_bridge::test
