// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "motion.h"

#include <cmath>
#include <stdexcept>

#include "c_api/records.h"

namespace trk_bridge::programs {
namespace {

/// PAL digital video, a 4:3 chip and blank borders at the sides.
wire::CameraConstants pal_constants() {
  wire::CameraConstants k;
  k.image_width = 720;
  k.image_height = 576;
  k.blank_left = k.blank_right = 10;
  k.chip_width = 6.4;
  k.chip_height = 4.8;
  return k;
}

/// Rest value of a parameter, and its amplitude to both sides.
struct Swing {
  double rest, amplitude;
};

camera::Camera camera_at(unsigned index) {
  const wire::CameraConstants k = pal_constants();
  // Metres, degrees (the field of view is horizontal), millimetres.
  const Swing swings[Motion::moved_parameters] = {
      {0, 3}, {-2, 5}, {1.5, 1}, {0, 90}, {0, 45}, {0, 60}, {45, 40}, {0, k.chip_width / 4}, {0, k.chip_height / 4}};
  const double phase = 2 * M_PI * (index % Motion::sets_per_parameter) / (Motion::sets_per_parameter - 1);
  double now[Motion::moved_parameters];
  for (unsigned i = 0; i < Motion::moved_parameters; ++i) now[i] = swings[i].rest;
  const unsigned moved = index / Motion::sets_per_parameter;
  now[moved] += swings[moved].amplitude * std::sin(phase);

  camera::Camera camera;
  camera.pose.translation() << now[0], now[1], now[2];
  camera.pose.linear() = camera::rotation_of({now[3], now[4], now[5]});
  camera.lens.image_distance = k.chip_width / 2 / std::tan(now[6] / 2 * M_PI / 180);
  camera.lens.center_shift = {now[7], now[8]};
  return camera;
}

}  // namespace

Motion::Motion(unsigned format) : converter_(format) { (void)converter_.use(pal_constants()); }

trkCameraConstants Motion::constants() const { return c_api::to_c(*converter_.outgoing()); }

trkCameraParams Motion::params(unsigned index) const {
  auto params = converter_.convert(camera_at(index));
  if (!params) throw std::runtime_error("the moving camera in this format: " + camera::describe(params.error()));
  params->counter = index + 1;
  return c_api::to_c(*params);
}

}  // namespace trk_bridge::programs
