// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// K and D of a CameraInfo: the lens model of OpenCV, undistorted to distorted, and its inverse. Points and radii are in
// units of the image distance, x right, y down.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "radial_fit.h"
#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

struct OpenCvLens {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  RadialModel radial;
  double p1 = 0, p2 = 0;

  bool is_radial() const noexcept { return p1 == 0 && p2 == 0; }
  /// The position of `pixel` on the (distorted) image.
  Eigen::Vector2d on_image(const Eigen::Vector2d& pixel) const noexcept;
  /// The displacement of the distorted point by p1 and p2.
  Eigen::Vector2d tangential(const Eigen::Vector2d& undistorted) const noexcept;
};

/// `k` is row-major; `d` has 0, 4, 5 or 8 coefficients. Error: bad_calibration.
[[nodiscard]] Result<OpenCvLens> opencv_lens(const std::array<double, 9>& k, const std::vector<double>& d) noexcept;

/// The inverse of a lens for distorted radii up to a reach.
class LensInverse {
 public:
  /// not_monotonic if the radial part folds within the reach, or never reaches it.
  [[nodiscard]] static Result<LensInverse> over(const OpenCvLens&, double reach) noexcept;

  /// For the radial part only, to full precision; `distorted` is 0 to the reach.
  double undistorted_radius(double distorted) const noexcept;
  /// For the complete lens, to full precision. not_monotonic if p1 and p2 fold it between the axis and the point.
  [[nodiscard]] Result<Eigen::Vector2d> undistorted(const Eigen::Vector2d& distorted) const noexcept;

 private:
  LensInverse(const OpenCvLens& lens, double reach, double undistorted_reach) noexcept
      : lens_(lens), reach_(reach), undistorted_reach_(undistorted_reach) {}

  OpenCvLens lens_;
  double reach_, undistorted_reach_;
};

}  // namespace trk_bridge::camera
