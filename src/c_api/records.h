// The document's C structures <-> the records of `wire`. Only libtrk_identified's structures have a camera id; without
// one, records have id 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"
#include "trk_struct.h"

namespace trk_bridge::c_api {

/// The fields of trkCameraParams, the transform excepted, under the names of the records.
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

/// Of the transformation only what `format` selects; the rest is zero.
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

/// The way back.
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

/// The way back.
inline wire::CameraConstants from_c(trkCameraConstants c) noexcept {
  wire::CameraConstants k;
  NamedConstants named{c};
  wire::copy_fields<wire::CameraConstants>(named, k);
  return k;
}

/// Parameters as today's programs have them in memory on a machine like this one: shm::default_layout.
struct NativeParams {
  unsigned id;
  unsigned format;
  trkTransform t;
  double fov, center_x, center_y, k1, k2, focdist, aperture;
  unsigned long counter;
};
/// Where they are that: not on 32 bits.
inline constexpr bool has_native_params = sizeof(NativeParams) == 200 && offsetof(NativeParams, t) == 8;

inline bool is_finite(const NativeParams& n) noexcept {
  // Of a number that is not finite, the difference with itself is none.
  double sum = (n.fov - n.fov) + (n.center_x - n.center_x) + (n.center_y - n.center_y) + (n.k1 - n.k1) + (n.k2 - n.k2) +
               (n.focdist - n.focdist) + (n.aperture - n.aperture);
  const double* const numbers = &n.t.m[0][0];
  const int count = wire::has(n.format, wire::euler) ? 6 : 16;
  for (int i = 0; i < count; ++i) sum += numbers[i] - numbers[i];
  return sum == 0;
}

/// Zero where the format says nothing of the transform.
inline void copy_transform(unsigned format, const trkTransform& from, trkTransform& to) noexcept {
  if (wire::has(format, wire::euler)) {
    to = {};
    to.e = from.e;
  } else {
    to = from;
  }
}

inline NativeParams to_native(const trkCameraParams& c) noexcept {
  NativeParams n{0, c.format, {}, c.fov, c.centerX, c.centerY, c.k1, c.k2, c.focdist, c.aperture, c.counter};
#ifdef TRK_IDENTIFIED
  n.id = c.id;
#endif
  copy_transform(c.format, c.t, n.t);
  return n;
}

inline void from_native(const NativeParams& n, trkCameraParams& c) noexcept {
#ifdef TRK_IDENTIFIED
  c.id = n.id;
#endif
  c.format = n.format;
  copy_transform(n.format, n.t, c.t);
  c.fov = n.fov;
  c.centerX = n.center_x;
  c.centerY = n.center_y;
  c.k1 = n.k1;
  c.k2 = n.k2;
  c.focdist = n.focdist;
  c.aperture = n.aperture;
  c.counter = n.counter;
}

/// Whether a program passed something that may be written.
inline bool is_writable(const trkCameraParams* params) {
  return params != nullptr && wire::is_writable(params->format);
}
inline bool is_writable(const trkCameraConstants* constants) { return constants != nullptr; }

}  // namespace trk_bridge::c_api
