// The numbers of a CameraInfo, and the lens that they describe: the one that trk can send, and the one to draw.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "camera/figure.h"
#include "trk_bridge/camera/calibration.h"

namespace trk_bridge::bridge {

/// What sensor_msgs/CameraInfo says of the raw image. Binning and region of interest are left out: by its definition
/// size, K and D are those of the full image, whatever part of it is sent and however it is binned. R and P, which
/// concern rectified images, are left out as well.
struct CameraInfo {
  std::uint32_t width = 0, height = 0;  ///< pixels
  std::string distortion_model;         ///< empty with no `d`: no distortion
  std::vector<double> d;                ///< OpenCV's coefficients: k1 k2 p1 p2 [k3 [k4 k5 k6]]
  std::array<double, 9> k{};            ///< row after row, pixels
};

/// What is wrong with a CameraInfo.
enum class InfoReason : std::uint8_t {
  no_size,        ///< width or height 0, or beyond what trk can hold
  unknown_model,  ///< neither plumb_bob nor rational_polynomial
  coefficients,   ///< D has another number of them than its model
  no_lens,        ///< `camera` says why K and D are no lens
};

/// Why a CameraInfo describes no lens.
struct InfoFault {
  InfoReason reason{};
  camera::CameraReason camera{};
};
/// One line for a person.
std::string describe(const InfoFault&);

/// The lens for trk: camera::fit_lens of K and D. Chip and blanks are those of `chip`, the image's size is that of the
/// CameraInfo. Takes about a tenth of a millisecond: keep the result while same_calibration().
[[nodiscard]] tl::expected<camera::FittedLens, InfoFault> fit_lens(const CameraInfo&,
                                                                   const wire::CameraConstants& chip) noexcept;

/// The lens to draw. camera::image_border() says whether it can be drawn. Errors: no_size, unknown_model, coefficients.
[[nodiscard]] tl::expected<camera::ViewingLens, InfoFault> viewing_lens(const CameraInfo&);

/// Whether both describe the same lens, number by number.
[[nodiscard]] bool same_calibration(const CameraInfo&, const CameraInfo&) noexcept;

}  // namespace trk_bridge::bridge
