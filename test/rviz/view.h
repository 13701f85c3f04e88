// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Where rviz's orbit view shows a point: a camera without distortion, computed from the view's properties alone.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trk_bridge::test {

class OrbitView {
 public:
  /// The view's properties: metres and radians, in the fixed frame.
  struct Place {
    Eigen::Vector3d focal_point = Eigen::Vector3d::Zero();
    double distance = 10, yaw = 0, pitch = 0;
    double field_of_view = 0.785398;  ///< from top to bottom
  };

  /// `size`: of the 3D view in pixels.
  OrbitView(const Place& place, const Eigen::Vector2d& size);

  /// In pixels from the upper left corner of the 3D view; the point is in front of the view.
  Eigen::Vector2d shows_at(const Eigen::Vector3d& point) const;

  bool contains(const Eigen::Vector2d& pixel) const;

 private:
  Eigen::Vector3d position_, forward_, right_, up_;
  Eigen::Vector2d size_;
  double pixels_a_unit_;
};

}  // namespace trk_bridge::test
