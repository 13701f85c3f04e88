// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Records of all kinds for the tests of the wire layer, and comparisons of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test {

template <class T>
void append_bits(std::string& bits, const T& value) {
  bits.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// All fields, byte for byte: -0 is not equal to 0.
inline std::string bits_of(const wire::CameraParams& p) {
  std::string bits;
  append_bits(bits, p.id);
  append_bits(bits, p.format);
  append_bits(bits, p.matrix);
  append_bits(bits, p.euler);
  for (const double value : {p.fov, p.center_x, p.center_y, p.k1, p.k2, p.focdist, p.aperture})
    append_bits(bits, value);
  append_bits(bits, p.counter);
  return bits;
}

inline std::string bits_of(const wire::CameraConstants& c) {
  std::string bits;
  append_bits(bits, c.id);
  for (const std::int32_t value :
       {c.image_width, c.image_height, c.blank_left, c.blank_right, c.blank_top, c.blank_bottom}) {
    append_bits(bits, value);
  }
  for (const double value : {c.chip_width, c.chip_height, c.fake_chip_width, c.fake_chip_height}) {
    append_bits(bits, value);
  }
  return bits;
}

inline std::string bits_of(const wire::Record& record) {
  return std::visit([](const auto& r) { return bits_of(r); }, record);
}

/// Which bytes of a parameter image contain data: all except padding and the part of the union that Euler angles do not
/// use.
inline std::vector<bool> bytes_with_data(const wire::CameraParams& p, wire::Layout layout) {
  const bool identified = layout.generation == wire::Generation::identified;
  const bool i386 = layout.abi == wire::Abi::i386;
  const std::size_t transform = i386 && !identified ? 4 : 8;
  std::vector<bool> data(wire::params_size(layout), true);
  if (!i386 && !identified) std::fill(data.begin() + 4, data.begin() + 8, false);
  if (layout.abi == wire::Abi::llp64) std::fill(data.end() - 4, data.end(), false);
  if (wire::has(p.format, wire::euler)) {
    const auto begin = data.begin() + static_cast<std::ptrdiff_t>(transform);
    std::fill(begin + 48, begin + 128, false);
  }
  return data;
}

/// Records with realistic values, the same for the same seed.
class RandomRecords {
 public:
  explicit RandomRecords(unsigned seed) : random_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::uint32_t whole(std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution<std::uint32_t>(low, high)(random_);
  }

  /// A rigid camera-to-studio matrix, columns first.
  std::array<double, 16> matrix() {
    double q[4];
    double norm = 0;
    for (double& value : q) {
      value = number(-1, 1);
      norm += value * value;
    }
    norm = std::sqrt(norm);
    const double w = q[0] / norm, x = q[1] / norm, y = q[2] / norm, z = q[3] / norm;
    return {1 - 2 * (y * y + z * z),
            2 * (x * y + w * z),
            2 * (x * z - w * y),
            0,
            2 * (x * y - w * z),
            1 - 2 * (x * x + z * z),
            2 * (y * z + w * x),
            0,
            2 * (x * z + w * y),
            2 * (y * z - w * x),
            1 - 2 * (x * x + y * y),
            0,
            number(-20, 20),
            number(-20, 20),
            number(0, 5),
            1};
  }

  wire::CameraParams params(std::uint32_t format) {
    wire::CameraParams p;
    p.format = format;
    if (wire::has(format, wire::euler)) {
      p.euler = {number(-20, 20), number(-20, 20), number(0, 5), number(-180, 180), number(-90, 90), number(-180, 180)};
    } else {
      p.matrix = matrix();
    }
    p.fov = number(4, 120);
    p.center_x = number(-0.2, 0.2);
    p.center_y = number(-0.2, 0.2);
    p.k1 = number(-1e-3, 1e-3);
    p.k2 = number(-1e-5, 1e-5);
    p.focdist = number(0.3, 50);
    p.aperture = number(1, 22);
    p.counter = whole(0, 0xFFFFFFFF);
    return p;
  }

  wire::CameraConstants constants() {
    wire::CameraConstants c;
    c.image_width = static_cast<std::int32_t>(whole(320, 4096));
    c.image_height = static_cast<std::int32_t>(whole(240, 2160));
    c.blank_left = static_cast<std::int32_t>(whole(0, 20));
    c.blank_right = static_cast<std::int32_t>(whole(0, 20));
    c.blank_top = static_cast<std::int32_t>(whole(0, 20));
    c.blank_bottom = static_cast<std::int32_t>(whole(0, 20));
    c.chip_width = number(4, 36);
    c.chip_height = number(3, 24);
    c.fake_chip_width = c.chip_width * 1.01;
    c.fake_chip_height = c.chip_height * 1.01;
    return c;
  }

 private:
  std::mt19937 random_;
};

/// The output of `encode`, which must succeed.
template <class T>
std::string encoded(const T& record, wire::WireForm form) {
  wire::Buffer buffer;
  const auto bytes = wire::encode(record, form, buffer);
  if (!bytes) throw std::runtime_error(wire::describe(bytes.error()));
  return std::string(*bytes);
}

}  // namespace trk_bridge::test
