// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The two records of the trk protocol as values, independent of their encoding.
#pragma once

#include <array>
#include <cstdint>
#include <variant>

namespace trk_bridge::wire {

/// `e` of trkTransform: position in metres and angles in degrees, in the frames given by `format`.
struct Euler {
  double x = 0, y = 0, z = 0, pan = 0, tilt = 0, roll = 0;
};

/// trkCameraParams, with the id of the identified generation. `format` determines the units (document, section "Camera
/// Parameters").
struct CameraParams {
  std::uint32_t id = 0;      ///< camera number; 0: not given
  std::uint32_t format = 0;  ///< FormatBit mask; unknown bits are kept
  /// 4x4, column-major: `matrix[4*j + i]` is row i, column j, in the document `t.m[j][i]`. Used without `euler`; zero
  /// with it.
  std::array<double, 16> matrix{};
  Euler euler;                        ///< used with `euler`; zero without it
  double fov = 0;                     ///< image distance in mm, or an angle in degrees
  double center_x = 0, center_y = 0;  ///< mm on the chip, or pixels
  double k1 = 0, k2 = 0;              ///< mm^-2, mm^-4
  double focdist = 0;                 ///< m
  double aperture = 0;
  std::uint64_t counter = 0;  ///< increases by one with every set
};

/// trkCameraConstants, with the id of the identified generation. Pixels and millimetres.
struct CameraConstants {
  std::uint32_t id = 0;
  std::int32_t image_width = 0, image_height = 0;
  std::int32_t blank_left = 0, blank_right = 0, blank_top = 0, blank_bottom = 0;
  double chip_width = 0, chip_height = 0, fake_chip_width = 0, fake_chip_height = 0;
};

/// The content of a datagram or a line.
using Record = std::variant<CameraParams, CameraConstants>;

/// Equal in every field, doubles by value; of `matrix` and `euler`, only the one selected by `format` is compared.
bool operator==(const CameraParams&, const CameraParams&) noexcept;
bool operator==(const CameraConstants&, const CameraConstants&) noexcept;
inline bool operator!=(const CameraParams& a, const CameraParams& b) noexcept { return !(a == b); }
inline bool operator!=(const CameraConstants& a, const CameraConstants& b) noexcept { return !(a == b); }

}  // namespace trk_bridge::wire
