// CameraInfo as a lens: the one that trk can tell of it, and the one to draw.
#pragma once

#include <cstdint>
#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <tl/expected.hpp>

#include "trk_bridge/camera/calibration.h"
#include "camera/figure.h"

namespace trk_bridge::ros1 {

/// What is wrong with a CameraInfo.
enum class InfoReason : std::uint8_t {
  no_size,        ///< width or height 0, or beyond what trk can tell
  binned,         ///< the image is not the whole one
  region,         ///< likewise
  unknown_model,  ///< neither plumb_bob nor rational_polynomial
  coefficients,   ///< D has another number of them than its model
  no_lens,        ///< `camera` says why K and D are no lens
};

/// Why a CameraInfo tells no lens.
struct InfoFault {
  InfoReason reason{};
  camera::CameraReason camera{};
};
/// One line for a person.
std::string describe(const InfoFault&);

/// The lens of the whole, raw image: K and D. R and P, which concern rectified images, are not looked at. No model and
/// no coefficients is a lens without distortion. Chip and blanks are those of `chip`, the image's size is the
/// message's.
[[nodiscard]] tl::expected<camera::FittedLens, InfoFault> lens_of(const sensor_msgs::CameraInfo&,
                                                                  const wire::CameraConstants& chip) noexcept;

/// The lens of the whole, raw image, to be drawn, whatever part of it is sent and however it is binned: K and D belong
/// to width and height. image_border() says whether it can be. Errors: no_size, unknown_model, coefficients.
[[nodiscard]] tl::expected<camera::ViewingLens, InfoFault> viewing_lens(const sensor_msgs::CameraInfo&);

/// Size and coefficients of a CameraInfo decide its lens: whether two agree in them.
[[nodiscard]] bool same_calibration(const sensor_msgs::CameraInfo&, const sensor_msgs::CameraInfo&) noexcept;

}  // namespace trk_bridge::ros1
