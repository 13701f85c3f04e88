// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The camera that sees the test card: the path from the studio to pixels according to the document, including the lens.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "test_card_figure.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::demo {

/// A Line distorted by the lens, pixels in ROS coordinates (origin in the centre of the top left one, y down). Empty if
/// the camera does not see it.
using Polyline = std::vector<Eigen::Vector2d>;

/// Largest distance of a Polyline from the exact curve, pixels.
inline constexpr double chord_tolerance = 0.01;

/// Whether and where points and lines of the studio (m) are seen. Beyond the radius where k1, k2 fold the image nothing
/// is seen.
class View {
 public:
  /// Errors are those of camera::decode.
  static camera::Result<View> of(const wire::CameraParams&, const wire::CameraConstants&);

  std::optional<Eigen::Vector2d> see(const Eigen::Vector3d& point) const;
  /// Writes to `seen`, which is cleared first.
  void see(const Line& line, Polyline& seen) const;

  int width() const { return static_cast<int>(raster_.width); }
  int height() const { return static_cast<int>(raster_.height); }

 private:
  View(const camera::Camera&, const camera::Raster&);
  bool within_lens(const Eigen::Vector2d& undistorted) const;
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector2d& undistorted) const;
  void bend(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Polyline& seen) const;

  Eigen::Isometry3d camera_T_studio_;
  camera::Lens lens_;
  camera::Raster raster_;
  // mm around the optical axis: points farther away are outside the image or beyond the fold.
  double undistorted_reach_ = 0;
};

}  // namespace trk_bridge::demo
