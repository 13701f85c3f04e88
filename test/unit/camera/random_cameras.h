// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Cameras and constants over the full range of sensible values, the same in every run.
#pragma once

#include <random>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test {

class RandomCameras {
 public:
  camera::Camera camera() {
    camera::Camera c;
    c.pose.linear() = camera::rotation_of({between(-180, 180), between(-90, 90), between(-180, 180)});
    c.pose.translation() = Eigen::Vector3d(between(-20, 20), between(-20, 20), between(-20, 20));
    c.lens = {between(3, 200),      {between(-0.5, 0.5), between(-0.5, 0.5)},
              between(-1e-3, 1e-3), between(-1e-5, 1e-5),
              between(0, 50),       between(1, 22)};
    return c;
  }

  wire::CameraConstants constants() {
    wire::CameraConstants c;
    c.image_width = whole(320, 4096);
    c.image_height = whole(240, 2160);
    c.blank_left = whole(0, 20);
    c.blank_right = whole(0, 20);
    c.blank_top = whole(0, 20);
    c.blank_bottom = whole(0, 20);
    c.chip_width = between(4, 36);
    c.chip_height = between(3, 24);
    return c;
  }

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

 private:
  std::int32_t whole(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(engine_);
  }

  std::mt19937_64 engine_{19980901};
};

/// Every possible format mask of a record.
inline std::vector<std::uint32_t> meaningful_masks() {
  std::vector<std::uint32_t> masks;
  for (std::uint32_t mask = 0; mask <= wire::known_format_bits; ++mask) {
    if (!wire::has(mask, wire::vertical | wire::diagonal)) masks.push_back(mask);
  }
  return masks;
}

}  // namespace trk_bridge::test
