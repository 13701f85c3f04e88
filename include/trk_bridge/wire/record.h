// The two records of the trk protocol, as values: what every encoding of them carries.
#pragma once

#include <array>
#include <cstdint>
#include <variant>

namespace trk_bridge::wire {

/// Position in metres and angles in degrees of trkTransform's `e`, in the frames that `format` says.
struct Euler {
  double x = 0, y = 0, z = 0, pan = 0, tilt = 0, roll = 0;
};

/// trkCameraParams, with the id of the identified generation. Units are those of `format`
/// (document, section "Camera Parameters").
struct CameraParams {
  std::uint32_t id = 0;      ///< camera number; 0: not given
  std::uint32_t format = 0;  ///< FormatBit mask; unknown bits are kept
  /// 4x4 column after column: `matrix[4*j + i]` is row i, column j, the document's `t.m[j][i]`. Counts without
  /// `euler`, is zero with it.
  std::array<double, 16> matrix{};
  Euler euler;                        ///< counts with `euler`, is zero without it
  double fov = 0;                     ///< image distance in mm, or an angle in degrees
  double center_x = 0, center_y = 0;  ///< mm on the chip, or pixels
  double k1 = 0, k2 = 0;              ///< mm^-2, mm^-4
  double focdist = 0;                 ///< m
  double aperture = 0;
  std::uint64_t counter = 0;  ///< one more with every set
};

/// trkCameraConstants, with the id of the identified generation. Pixels and millimetres.
struct CameraConstants {
  std::uint32_t id = 0;
  std::int32_t image_width = 0, image_height = 0;
  std::int32_t blank_left = 0, blank_right = 0, blank_top = 0, blank_bottom = 0;
  double chip_width = 0, chip_height = 0, fake_chip_width = 0, fake_chip_height = 0;
};

/// What a datagram or a line carries.
using Record = std::variant<CameraParams, CameraConstants>;

/// Equal in every field, doubles by value; of `matrix` and `euler` only the one that `format` selects counts.
bool operator==(const CameraParams&, const CameraParams&) noexcept;
bool operator==(const CameraConstants&, const CameraConstants&) noexcept;
inline bool operator!=(const CameraParams& a, const CameraParams& b) noexcept { return !(a == b); }
inline bool operator!=(const CameraConstants& a, const CameraConstants& b) noexcept { return !(a == b); }

}  // namespace trk_bridge::wire
