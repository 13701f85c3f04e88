// Cameras between two samples.
#pragma once

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// A record's camera in numbers that can be interpolated with those of another record of the same format and constants,
/// which need not be known: an angle of view is the image distance over the side that it is seen over, and the centre
/// shift is as in the record. Errors: those of decode_pose, not_finite and bad_field_of_view for the lens, and
/// bad_format for what encode_relative() could not write.
[[nodiscard]] Result<Camera> decode_relative(const wire::CameraParams&) noexcept;
/// The way back; id 0 and counter 0.
[[nodiscard]] Result<wire::CameraParams> encode_relative(const Camera&, std::uint32_t format) noexcept;

/// `part` is 0 at `a` and 1 at `b`; outside of that it extrapolates. Every number is linear, the image distance (so the
/// focal length, whatever the format) among them.
[[nodiscard]] Lens interpolate(const Lens& a, const Lens& b, double part) noexcept;
/// Slerp, the shorter way round.
[[nodiscard]] Eigen::Matrix3d interpolate(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double part) noexcept;
/// Linear.
[[nodiscard]] inline Eigen::Vector3d interpolate(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 double part) noexcept {
  return a + part * (b - a);
}

}  // namespace trk_bridge::camera
