// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "print.h"

#include <array>

#include "trk_bridge/wire/fields.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::programs {
namespace {

// The lines below are written by hand and must print every field except the camera id.
static_assert(wire::field_count<wire::CameraParams>() == 10 && wire::field_count<wire::Euler>() == 6 &&
              wire::field_count<wire::CameraConstants>() == 11);

// Column of the values, which differs between the blocks.
constexpr int constants_column = 20, params_column = 18;

void print_constant(std::FILE* out, const char* label, int value) {
  std::fprintf(out, "\t%-*s%d\n", constants_column, label, value);
}
void print_constant(std::FILE* out, const char* label, double value) {
  std::fprintf(out, "\t%-*s%g\n", constants_column, label, value);
}
void print_parameter(std::FILE* out, const char* label, double value) {
  std::fprintf(out, "\t%-*s%g\n", params_column, label, value);
}

}  // namespace

void print(std::FILE* out, const trkCameraConstants& c) {
  std::fputs("Camera constants:\n", out);
  print_constant(out, "image width:", c.imageWidth);
  print_constant(out, "image height:", c.imageHeight);
  print_constant(out, "blank left:", c.blankLeft);
  print_constant(out, "blank right:", c.blankRight);
  print_constant(out, "blank top:", c.blankTop);
  print_constant(out, "blank bottom:", c.blankBottom);
  print_constant(out, "chip width:", c.chipWidth);
  print_constant(out, "chip height:", c.chipHeight);
  print_constant(out, "fake chip width:", c.fakeChipWidth);
  print_constant(out, "fake chip height:", c.fakeChipHeight);
  std::fputs("\n", out);
}

void print(std::FILE* out, const trkCameraParams& p) {
  std::array<char, trkStringSize> words{};
  trkFormatToString(p.format, words.data());
  std::fputs("Camera parameters:\n", out);
  std::fprintf(out, "\t%-*s%s\n", params_column, "format:", words.data());
  if (wire::has(p.format, trkEuler)) {
    print_parameter(out, "x:", p.t.e.x);
    print_parameter(out, "y:", p.t.e.y);
    print_parameter(out, "z:", p.t.e.z);
    print_parameter(out, "pan:", p.t.e.pan);
    print_parameter(out, "tilt:", p.t.e.tilt);
    print_parameter(out, "roll:", p.t.e.roll);
  } else {
    std::fputs("\tmatrix:\n", out);
    for (int row = 0; row < 4; ++row) {
      std::fprintf(out, "\t\t%14g%14g%14g%14g\n", p.t.m[0][row], p.t.m[1][row], p.t.m[2][row], p.t.m[3][row]);
    }
  }
  print_parameter(out, "field of view:", p.fov);
  print_parameter(out, "center shift x:", p.centerX);
  print_parameter(out, "center shift y:", p.centerY);
  print_parameter(out, "distorsion k1:", p.k1);
  print_parameter(out, "distorsion k2:", p.k2);
  print_parameter(out, "focal distance:", p.focdist);
  print_parameter(out, "aperture:", p.aperture);
  std::fprintf(out, "\t%-*s%lu\n\n", params_column, "counter:", p.counter);
}

}  // namespace trk_bridge::programs
