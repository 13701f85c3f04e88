// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/camera.h"

#include "params.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera {

std::string describe(CameraReason reason) {
  switch (reason) {
    case CameraReason::not_finite:
      return "a number of the camera is not finite";
    case CameraReason::not_a_rotation:
      return "the matrix is not a rigid motion: its rotation is not orthonormal to 1e-3, is a reflection, or its "
             "bottom row is not 0 0 0 1";
    case CameraReason::constants_needed:
      return "the format needs camera constants (field of view, ignored blanks and shift in pixels do) and none are "
             "known";
    case CameraReason::bad_constants:
      return "the camera constants leave no picture: image and chip must be larger than 0, blanks not negative and "
             "smaller than the image";
    case CameraReason::bad_field_of_view:
      return "the field of view must be more than 0 and less than 180 degrees, the image distance more than 0 mm";
    case CameraReason::bad_format:
      return "no record can be written in this format: it has unknown bits, or both vertical and diagonal";
    case CameraReason::not_monotonic:
      return "the distortion folds within the image: it has no inverse there";
    case CameraReason::behind_camera:
      return "the point is not in front of the camera";
    case CameraReason::no_fit:
      return "no distortion model with finite coefficients can be fitted to the lens";
    case CameraReason::bad_calibration:
      return "K must be fx 0 cx 0 fy cy 0 0 1 with fx and fy more than 0, D have 0, 4, 5 or 8 coefficients, and all be "
             "finite";
    case CameraReason::no_lens:
      return "the records have no lens";
    case CameraReason::too_wide:
      return "the image extends more than 89 degrees from the optical axis: too wide to be drawn";
  }
  return "unknown reason";
}

Result<Camera> decode(const wire::CameraParams& params, const wire::CameraConstants* constants) noexcept {
  const Result<Eigen::Isometry3d> pose = decode_pose(params);
  if (!pose) return tl::unexpected(pose.error());
  const Result<Lens> lens = decode_lens(params, constants);
  if (!lens) return tl::unexpected(lens.error());
  return Camera{*pose, *lens};
}

Result<wire::CameraParams> encode(const Camera& camera, std::uint32_t format,
                                  const wire::CameraConstants* constants) noexcept {
  if (!wire::is_writable(format)) return tl::unexpected(CameraReason::bad_format);
  wire::CameraParams params;
  params.format = format;
  if (const auto pose = encode_pose(camera.pose, params); !pose) return tl::unexpected(pose.error());
  if (const auto lens = encode_lens(camera.lens, constants, params); !lens) return tl::unexpected(lens.error());
  return params;
}

}  // namespace trk_bridge::camera
