// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Records of a camera, for tests that need any record.
#pragma once

#include <cstdint>

#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::test {

inline wire::CameraParams params(std::uint64_t counter, std::uint32_t id = 0) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {1.5, -2, 1.75, 30, -5, 0.25};
  p.fov = 42;
  p.focdist = 4.5;
  p.counter = counter;
  return p;
}

inline wire::CameraConstants constants(int width = 720, std::uint32_t id = 0) {
  wire::CameraConstants c;
  c.id = id;
  c.image_width = width;
  c.image_height = 576;
  c.chip_width = c.fake_chip_width = 8.8;
  c.chip_height = c.fake_chip_height = 6.6;
  return c;
}

}  // namespace trk_bridge::test
