// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads, writes and converts the pose and the lens of a parameter record (pose.cpp, lens.cpp).
#pragma once

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Writes `matrix` or `euler` of `params`, as selected by `params.format`; the other one is not changed. Errors:
/// not_a_rotation, not_finite.
[[nodiscard]] Result<void> encode_pose(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept;

/// Writes the pose of `params` in the format of `out`. The doubles are copied unchanged if the options that they depend
/// on are the same, as are the angles from Euler to Euler. `pose` is decode_pose(params).
[[nodiscard]] Result<void> convert_pose(const wire::CameraParams& params, const Result<Eigen::Isometry3d>& pose,
                                        wire::CameraParams& out) noexcept;

/// The meaning of fov: an angle over `side` mm of chip, or the image distance if `side` is 0.
struct FovTerms {
  double side = 0;
};

/// The meaning of the centre shift: (shift - offset) * scale, with the shift in mm on the chip.
struct ShiftTerms {
  Eigen::Array2d offset = Eigen::Array2d::Zero();
  Eigen::Array2d scale = Eigen::Array2d::Ones();
};

/// The values of a lens that need constants, with the terms that were used to read them.
struct LensParts {
  Result<FovTerms> fov_terms;
  Result<ShiftTerms> shift_terms;
  Result<double> image_distance;
  Result<Eigen::Vector2d> center_shift;
};
[[nodiscard]] LensParts lens_parts(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;

/// The complete lens of `params`; `parts` are the parts of `params`.
[[nodiscard]] Result<Lens> decode_lens(const wire::CameraParams& params, const LensParts& parts) noexcept;

/// Writes fov, centre shift, k1, k2, focdist and aperture of `params` in the format `params.format`.
[[nodiscard]] Result<void> encode_lens(const Lens&, const wire::CameraConstants* constants,
                                       wire::CameraParams& params) noexcept;

/// Writes the lens of `params` in the format of `out`. Field of view and centre shift are each copied unchanged if the
/// options and constants that they depend on are the same. `parts` are those of `params`.
[[nodiscard]] Result<void> convert_lens(const wire::CameraParams& params, const LensParts& parts,
                                        const wire::CameraConstants* outgoing, wire::CameraParams& out) noexcept;

}  // namespace trk_bridge::camera
