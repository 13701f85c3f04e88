// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts the C structures of the document to the records of `wire` and back. Only the structures of libtrk_identified
// have a camera id; otherwise, records have id 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"
#include "trk_struct.h"

namespace trk_bridge::c_api {

/// The fields of trkCameraParams, except the transform, under the names of the records.
struct NamedParams {
  trkCameraParams& c;
#ifdef TRK_IDENTIFIED
  unsigned& id = c.id;
#else
  std::uint32_t id = 0;
#endif
  unsigned& format = c.format;
  double& fov = c.fov;
  double& center_x = c.centerX;
  double& center_y = c.centerY;
  double& k1 = c.k1;
  double& k2 = c.k2;
  double& focdist = c.focdist;
  double& aperture = c.aperture;
  unsigned long& counter = c.counter;
};

/// The fields of trkCameraConstants under the names of the records.
struct NamedConstants {
  trkCameraConstants& c;
#ifdef TRK_IDENTIFIED
  unsigned& id = c.id;
#else
  std::uint32_t id = 0;
#endif
  int& image_width = c.imageWidth;
  int& image_height = c.imageHeight;
  int& blank_left = c.blankLeft;
  int& blank_right = c.blankRight;
  int& blank_top = c.blankTop;
  int& blank_bottom = c.blankBottom;
  double& chip_width = c.chipWidth;
  double& chip_height = c.chipHeight;
  double& fake_chip_width = c.fakeChipWidth;
  double& fake_chip_height = c.fakeChipHeight;
};

/// Of the transform, only the part selected by `format` is copied; the rest is zero.
inline trkCameraParams to_c(const wire::CameraParams& p) noexcept {
  trkCameraParams c{};
  NamedParams named{c};
  wire::copy_fields<wire::CameraParams>(p, named);
  if (wire::has(p.format, wire::euler)) {
    wire::copy_fields<wire::Euler>(p.euler, c.t.e);
  } else {
    std::copy(p.matrix.begin(), p.matrix.end(), &c.t.m[0][0]);
  }
  return c;
}

/// The inverse.
inline wire::CameraParams from_c(trkCameraParams c) noexcept {
  wire::CameraParams p;
  NamedParams named{c};
  wire::copy_fields<wire::CameraParams>(named, p);
  if (wire::has(p.format, wire::euler)) {
    wire::copy_fields<wire::Euler>(c.t.e, p.euler);
  } else {
    std::copy_n(&c.t.m[0][0], p.matrix.size(), p.matrix.begin());
  }
  return p;
}

inline trkCameraConstants to_c(const wire::CameraConstants& k) noexcept {
  trkCameraConstants c{};
  NamedConstants named{c};
  wire::copy_fields<wire::CameraConstants>(k, named);
  return c;
}

/// The inverse.
inline wire::CameraConstants from_c(trkCameraConstants c) noexcept {
  wire::CameraConstants k;
  NamedConstants named{c};
  wire::copy_fields<wire::CameraConstants>(named, k);
  return k;
}

/// Parameters in shm::default_layout, as programs in use have them in memory on a machine like this one. Words: id and
/// format, the transform (16 numbers), seven numbers, the counter. From the transform on, the structures of both header
/// sets are equal.
inline constexpr std::size_t native_words = 25;
using NativeParams = std::array<std::uint64_t, native_words>;
/// Whether the structures have this layout: not on 32-bit machines.
inline constexpr bool has_native_params =
    sizeof(NativeParams) == sizeof(trkCameraParams) && offsetof(trkCameraParams, t) == sizeof(std::uint64_t) &&
    sizeof(unsigned long) == sizeof(std::uint64_t) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

inline unsigned format_of(const NativeParams& n) noexcept { return static_cast<unsigned>(n[0] >> 32U); }

/// Indices of words: the first after the Euler angles, the transform and the lens.
inline constexpr std::size_t after_euler = 7, after_transform = 17, after_lens = 24;

/// The words of a structure. One at a time: programs have just changed some of them, and a wider load would stall.
struct WordsOf {
  const trkCameraParams& c;

  std::uint64_t operator[](std::size_t i) const noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, reinterpret_cast<const char*>(&c) + i * sizeof word, sizeof word);
#ifndef TRK_IDENTIFIED
    if (i == 0) word = std::uint64_t{c.format} << 32U;
#endif
    return word;
  }
};

/// Whether the numbers that the format uses are finite.
template <typename Words>
bool is_finite(const Words& words, unsigned format) noexcept {
  // An exponent of all ones carries into bit 63 when its lowest bit is added. Integers, because a sum of doubles has to
  // wait for each term.
  constexpr std::uint64_t exponent = 0x7FF0'0000'0000'0000, lowest = 0x0010'0000'0000'0000;
  std::uint64_t carried = 0;
  const auto carry = [&](std::size_t i) { carried |= (words[i] & exponent) + lowest; };
#pragma GCC unroll 8
  for (std::size_t i = after_transform; i < after_lens; ++i) carry(i);
#pragma GCC unroll 8
  for (std::size_t i = 1; i < after_euler; ++i) carry(i);
  if (!wire::has(format, wire::euler)) {
#pragma GCC unroll 16
    for (std::size_t i = after_euler; i < after_transform; ++i) carry(i);
  }
  return carried >> 63U == 0;
}

/// Whether word i is a number of the matrix that Euler angles do not use: it is written as zero.
constexpr bool is_beyond_euler(std::size_t i) noexcept { return i >= after_euler && i < after_transform; }

inline void from_native(const NativeParams& n, trkCameraParams& c) noexcept {
#ifdef TRK_IDENTIFIED
  c.id = static_cast<unsigned>(n[0]);
#endif
  c.format = format_of(n);
  std::memcpy(reinterpret_cast<char*>(&c) + sizeof n[0], &n[1], sizeof n - sizeof n[0]);
  if (!wire::has(format_of(n), wire::euler)) return;
  std::memset(reinterpret_cast<char*>(&c) + after_euler * sizeof n[0], 0,
              (after_transform - after_euler) * sizeof n[0]);
}

/// Whether the arguments of a program can be written.
inline bool is_writable(const trkCameraParams* params) {
  return params != nullptr && wire::is_writable(params->format);
}
inline bool is_writable(const trkCameraConstants* constants) { return constants != nullptr; }

}  // namespace trk_bridge::c_api
