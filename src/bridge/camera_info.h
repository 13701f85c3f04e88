// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The numbers of a CameraInfo, and the lens that they describe: as trk can send it, and as it is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "camera/figure.h"
#include "trk_bridge/camera/calibration.h"

namespace trk_bridge::bridge {

/// The part of sensor_msgs/CameraInfo that describes the raw image. Binning and region of interest are omitted: by
/// definition, size, K and D always refer to the full image. R and P concern rectified images and are omitted as well.
struct CameraInfo {
  std::uint32_t width = 0, height = 0;  ///< pixels
  std::string distortion_model;         ///< empty with no `d`: no distortion
  std::vector<double> d;                ///< OpenCV's coefficients: k1 k2 p1 p2 [k3 [k4 k5 k6]]
  std::array<double, 9> k{};            ///< row-major, pixels
};

/// What is wrong with a CameraInfo.
enum class InfoReason : std::uint8_t {
  no_size,        ///< width or height is 0, or larger than trk can hold
  unknown_model,  ///< neither plumb_bob nor rational_polynomial
  coefficients,   ///< the size of D does not fit the model
  no_lens,        ///< K and D are not a valid lens; `camera` is the reason
};

/// Why a CameraInfo describes no lens.
struct InfoFault {
  InfoReason reason{};
  camera::CameraReason camera{};
};
/// One line of text for people.
std::string describe(const InfoFault&);

/// The lens for trk: camera::fit_lens of K and D. Chip size and blanks are taken from `chip`, the image size from the
/// CameraInfo. Takes about 0.1 ms: keep the result while same_calibration().
[[nodiscard]] tl::expected<camera::FittedLens, InfoFault> fit_lens(const CameraInfo&,
                                                                   const wire::CameraConstants& chip) noexcept;

/// The lens to draw. camera::image_border() says whether it can be drawn. Errors: no_size, unknown_model, coefficients.
[[nodiscard]] tl::expected<camera::ViewingLens, InfoFault> viewing_lens(const CameraInfo&);

/// Whether all numbers that describe the lens are equal.
[[nodiscard]] bool same_calibration(const CameraInfo&, const CameraInfo&) noexcept;

}  // namespace trk_bridge::bridge
