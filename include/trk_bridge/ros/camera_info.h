// CameraInfo as the lens that trk can tell of it.
#pragma once

#include <cstdint>
#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <tl/expected.hpp>

#include "trk_bridge/camera/calibration.h"

namespace trk_bridge::ros1 {

enum class InfoReason : std::uint8_t {
  no_size,        ///< width or height 0, or beyond what trk can tell
  binned,         ///< the image is not the whole one
  region,         ///< likewise
  unknown_model,  ///< neither plumb_bob nor rational_polynomial
  coefficients,   ///< D has another number of them than its model
  no_lens,        ///< `camera` says why K and D are no lens
};

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

/// Size and coefficients of a CameraInfo decide its lens: whether two agree in them.
[[nodiscard]] bool same_calibration(const sensor_msgs::CameraInfo&, const sensor_msgs::CameraInfo&) noexcept;

}  // namespace trk_bridge::ros1
