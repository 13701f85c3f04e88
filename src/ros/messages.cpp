#include "trk_bridge/ros/messages.h"

#include <algorithm>
#include <cstdint>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {

using Params = trk_bridge::CameraParams;

constexpr bool same(std::uint32_t of_message, wire::FormatBit bit) { return of_message == std::uint32_t{bit}; }

static_assert(same(Params::EULER, wire::euler) && same(Params::STUDIO_TO_CAMERA, wire::studio_to_camera) &&
              same(Params::CAMERA_Y_UP, wire::camera_y_up) && same(Params::STUDIO_Y_UP, wire::studio_y_up) &&
              same(Params::FIELD_OF_VIEW, wire::field_of_view) && same(Params::VERTICAL, wire::vertical) &&
              same(Params::DIAGONAL, wire::diagonal) && same(Params::IGNORE_BLANK, wire::ignore_blank) &&
              same(Params::KEEP_ASPECT, wire::keep_aspect) && same(Params::SHIFT_IN_PIXELS, wire::shift_in_pixels));

void to_msg(const wire::CameraParams& params, Params& message) {
  const bool euler = wire::has(params.format, wire::euler);
  const wire::Euler pose = euler ? params.euler : wire::Euler{};
  message.id = params.id;
  message.counter = params.counter;
  message.format = params.format;
  if (euler) {
    message.matrix.fill(0);
  } else {
    std::copy(params.matrix.begin(), params.matrix.end(), message.matrix.begin());
  }
  message.x = pose.x;
  message.y = pose.y;
  message.z = pose.z;
  message.pan = pose.pan;
  message.tilt = pose.tilt;
  message.roll = pose.roll;
  message.fov = params.fov;
  message.center_x = params.center_x;
  message.center_y = params.center_y;
  message.k1 = params.k1;
  message.k2 = params.k2;
  message.focdist = params.focdist;
  message.aperture = params.aperture;
}

void to_msg(const wire::CameraConstants& constants, trk_bridge::CameraConstants& message) {
  message.id = constants.id;
  message.image_width = constants.image_width;
  message.image_height = constants.image_height;
  message.blank_left = constants.blank_left;
  message.blank_right = constants.blank_right;
  message.blank_top = constants.blank_top;
  message.blank_bottom = constants.blank_bottom;
  message.chip_width = constants.chip_width;
  message.chip_height = constants.chip_height;
  message.fake_chip_width = constants.fake_chip_width;
  message.fake_chip_height = constants.fake_chip_height;
}

void to_msg(const camera::Calibration& calibration, sensor_msgs::CameraInfo& message) {
  const auto& k = calibration.k;
  const auto& distortion = calibration.distortion;
  const bool rational = distortion.model == camera::DistortionModel::rational_polynomial;
  message.width = calibration.width;
  message.height = calibration.height;
  message.distortion_model = camera::name(distortion.model);
  message.D.assign(distortion.d.begin(), distortion.d.begin() + (rational ? 8 : 5));
  std::copy(k.begin(), k.end(), message.K.begin());
  message.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  message.P = {k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0};
}

wire::CameraParams from_msg(const Params& message) {
  wire::CameraParams params;
  params.id = message.id;
  params.counter = message.counter;
  params.format = message.format;
  if (wire::has(params.format, wire::euler)) {
    params.euler = {message.x, message.y, message.z, message.pan, message.tilt, message.roll};
  } else {
    std::copy(message.matrix.begin(), message.matrix.end(), params.matrix.begin());
  }
  params.fov = message.fov;
  params.center_x = message.center_x;
  params.center_y = message.center_y;
  params.k1 = message.k1;
  params.k2 = message.k2;
  params.focdist = message.focdist;
  params.aperture = message.aperture;
  return params;
}

wire::CameraConstants from_msg(const trk_bridge::CameraConstants& message) {
  wire::CameraConstants constants;
  constants.id = message.id;
  constants.image_width = message.image_width;
  constants.image_height = message.image_height;
  constants.blank_left = message.blank_left;
  constants.blank_right = message.blank_right;
  constants.blank_top = message.blank_top;
  constants.blank_bottom = message.blank_bottom;
  constants.chip_width = message.chip_width;
  constants.chip_height = message.chip_height;
  constants.fake_chip_width = message.fake_chip_width;
  constants.fake_chip_height = message.fake_chip_height;
  return constants;
}

}  // namespace trk_bridge::ros1
