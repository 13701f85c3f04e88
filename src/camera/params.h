// Pose and lens of a parameter record, each by itself: read, written and converted (pose.cpp, lens.cpp).
#pragma once

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Writes `matrix` or `euler` of `params` as `params.format` says; the other one is not touched. Refuses
/// (not_a_rotation, not_finite) what is not a pose.
[[nodiscard]] Result<void> encode_pose(const Eigen::Isometry3d& pose, wire::CameraParams& params) noexcept;

/// The pose of `params` in the format of `out`: the very doubles where the options that they depend on agree, the very
/// angles from Euler to Euler. `pose` is decode_pose(params).
[[nodiscard]] Result<void> convert_pose(const wire::CameraParams& params, const Result<Eigen::Isometry3d>& pose,
                                        wire::CameraParams& out) noexcept;

/// What fov is: an angle over `side` mm of chip, or, where that is 0, the image distance.
struct FovTerms {
  double side = 0;
};

/// What the centre shift is: (shift - offset) * scale, with the shift in mm on the chip.
struct ShiftTerms {
  Eigen::Array2d offset = Eigen::Array2d::Zero();
  Eigen::Array2d scale = Eigen::Array2d::Ones();
};

/// What needs constants in a record's lens, each number with the terms that it was read by.
struct LensParts {
  Result<FovTerms> fov_terms;
  Result<ShiftTerms> shift_terms;
  Result<double> image_distance;
  Result<Eigen::Vector2d> center_shift;
};
[[nodiscard]] LensParts lens_parts(const wire::CameraParams&, const wire::CameraConstants* constants) noexcept;

/// The whole lens of `params`, of which `parts` are the parts.
[[nodiscard]] Result<Lens> decode_lens(const wire::CameraParams& params, const LensParts& parts) noexcept;

/// Writes fov, centre shift, k1, k2, focdist and aperture of `params` as `params.format` says.
[[nodiscard]] Result<void> encode_lens(const Lens&, const wire::CameraConstants* constants,
                                       wire::CameraParams& params) noexcept;

/// The lens of `params` in the format of `out`. Field of view and centre shift each keep their very doubles where
/// neither the options nor the constants they depend on differ. `parts` are those of `params`.
[[nodiscard]] Result<void> convert_lens(const wire::CameraParams& params, const LensParts& parts,
                                        const wire::CameraConstants* outgoing, wire::CameraParams& out) noexcept;

}  // namespace trk_bridge::camera
