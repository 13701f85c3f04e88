// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <trk_bridge/camera/converter.h>
#include <trk_bridge/wire/codec.h>
#include <trk_bridge/wire/format.h>

// A camera of this program, written as the record of a datagram and read again from its bytes.
int main() {
  trk_bridge::camera::Camera camera;
  camera.pose.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  camera.lens.image_distance = 10;
  const trk_bridge::camera::Converter converter;
  const auto params = converter.convert(camera);
  if (!params) {
    return 1;
  }
  trk_bridge::wire::Buffer buffer;
  const auto text = trk_bridge::wire::to_text(*params, buffer);
  if (!text) {
    return 2;
  }
  const auto again = trk_bridge::wire::params_from_text(*text);
  if (!again) {
    return 3;
  }
  const auto pose = converter.convert(*again).pose;
  return pose && (pose->translation() - camera.pose.translation()).norm() < 1e-9 ? 0 : 4;
}
