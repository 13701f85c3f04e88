// The document's C structures <-> the records of the core. The C interface has no camera id.
#pragma once

#include <trk/trk_struct.h>

#include <algorithm>

#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::c_api {

/// Of the transformation only what `format` selects; the rest is zero.
inline trkCameraParams to_c(const wire::CameraParams& p) noexcept {
  trkCameraParams c{};
  c.format = p.format;
  if (wire::has(p.format, wire::euler)) {
    c.t.e = {p.euler.x, p.euler.y, p.euler.z, p.euler.pan, p.euler.tilt, p.euler.roll};
  } else {
    std::copy(p.matrix.begin(), p.matrix.end(), &c.t.m[0][0]);
  }
  c.fov = p.fov;
  c.centerX = p.center_x;
  c.centerY = p.center_y;
  c.k1 = p.k1;
  c.k2 = p.k2;
  c.focdist = p.focdist;
  c.aperture = p.aperture;
  c.counter = static_cast<unsigned long>(p.counter);
  return c;
}

/// The way back; the id is 0.
inline wire::CameraParams from_c(const trkCameraParams& c) noexcept {
  wire::CameraParams p;
  p.format = c.format;
  if (wire::has(c.format, wire::euler)) {
    p.euler = {c.t.e.x, c.t.e.y, c.t.e.z, c.t.e.pan, c.t.e.tilt, c.t.e.roll};
  } else {
    std::copy_n(&c.t.m[0][0], p.matrix.size(), p.matrix.begin());
  }
  p.fov = c.fov;
  p.center_x = c.centerX;
  p.center_y = c.centerY;
  p.k1 = c.k1;
  p.k2 = c.k2;
  p.focdist = c.focdist;
  p.aperture = c.aperture;
  p.counter = c.counter;
  return p;
}

inline trkCameraConstants to_c(const wire::CameraConstants& k) noexcept {
  return {k.image_width,  k.image_height, k.blank_left,  k.blank_right,     k.blank_top,
          k.blank_bottom, k.chip_width,   k.chip_height, k.fake_chip_width, k.fake_chip_height};
}

/// The way back; the id is 0.
inline wire::CameraConstants from_c(const trkCameraConstants& c) noexcept {
  return {0,           c.imageWidth, c.imageHeight,   c.blankLeft,     c.blankRight, c.blankTop, c.blankBottom,
          c.chipWidth, c.chipHeight, c.fakeChipWidth, c.fakeChipHeight};
}

/// Whether a program passed something that may be written.
inline bool is_writable(const trkCameraParams* params) {
  return params != nullptr && wire::is_writable(params->format);
}
inline bool is_writable(const trkCameraConstants* constants) { return constants != nullptr; }

}  // namespace trk_bridge::c_api
