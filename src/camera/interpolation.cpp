// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/interpolation.h"

#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera {
namespace {

/// A chip of 1 mm, so that image distances are multiples of its side. This also works for the diagonal, which only
/// scales.
constexpr wire::CameraConstants unit_chip{0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1};

/// Blanks and pixels only scale and shift the numbers of a lens: interpolation gives the same result without them.
constexpr std::uint32_t without_constants(std::uint32_t format) noexcept {
  return format & ~std::uint32_t{wire::ignore_blank | wire::keep_aspect | wire::shift_in_pixels};
}

}  // namespace

Result<Camera> decode_relative(const wire::CameraParams& params) noexcept {
  if (!wire::is_writable(params.format)) return tl::unexpected(CameraReason::bad_format);
  auto relative = params;
  relative.format = without_constants(params.format);
  return decode(relative, &unit_chip);
}

Result<wire::CameraParams> encode_relative(const Camera& camera, std::uint32_t format) noexcept {
  if (!wire::is_writable(format)) return tl::unexpected(CameraReason::bad_format);
  auto params = encode(camera, without_constants(format), &unit_chip);
  if (params) params->format = format;
  return params;
}

Lens interpolate(const Lens& a, const Lens& b, double part) noexcept {
  const auto between = [part](double from, double to) { return from + part * (to - from); };
  return {between(a.image_distance, b.image_distance),
          a.center_shift + part * (b.center_shift - a.center_shift),
          between(a.k1, b.k1),
          between(a.k2, b.k2),
          between(a.focdist, b.focdist),
          between(a.aperture, b.aperture)};
}

Eigen::Matrix3d interpolate(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double part) noexcept {
  // At the samples, the result is exact.
  if (part == 0) return a;
  if (part == 1) return b;
  return Eigen::Quaterniond(a).slerp(part, Eigen::Quaterniond(b)).normalized().toRotationMatrix();
}

}  // namespace trk_bridge::camera
