// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The motion that the writing programs send: one parameter moves after another (document, section 6.2).
#pragma once

#include "trk_bridge/camera/converter.h"
#include "trk_struct.h"

namespace trk_bridge::programs {

class Motion {
 public:
  /// `format` must be one that can be written.
  explicit Motion(unsigned format);

  /// With a fake chip that fits the aspect option of the format.
  trkCameraConstants constants() const;
  /// Set `index` of the motion, below `sets`; its counter is `index` + 1. Throws std::runtime_error if the format
  /// cannot express the camera.
  trkCameraParams params(unsigned index) const;

  /// x, y, z, pan, tilt, roll, field of view, center shift in x and in y. Each makes one period around its rest value.
  static constexpr unsigned moved_parameters = 9;
  static constexpr unsigned sets_per_parameter = 251;
  static constexpr unsigned sets = moved_parameters * sets_per_parameter;

 private:
  camera::Converter converter_;
};

}  // namespace trk_bridge::programs
