// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/ros/messages.h"

#include <algorithm>
#include <cstdint>

#include "bridge/stamper.h"
#include "trk_bridge/wire/fields.h"
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
  wire::copy_fields<wire::CameraParams>(params, message);
  const bool euler = wire::has(params.format, wire::euler);
  const wire::Euler pose = euler ? params.euler : wire::Euler{};
  wire::copy_fields<wire::Euler>(pose, message);
  if (euler) {
    message.matrix.fill(0);
  } else {
    std::copy(params.matrix.begin(), params.matrix.end(), message.matrix.begin());
  }
}

void to_msg(const wire::CameraConstants& constants, trk_bridge::CameraConstants& message) {
  wire::copy_fields<wire::CameraConstants>(constants, message);
}

void to_msg(const base::TimeCodeWithRate& time_code, trk_bridge::TimeCode& message) {
  const auto part = [](int value) { return static_cast<std::uint8_t>(value); };
  message.hours = part(time_code.code.hours);
  message.minutes = part(time_code.code.minutes);
  message.seconds = part(time_code.code.seconds);
  message.frames = part(time_code.code.frames);
  message.field = part(time_code.code.field);
  message.drop_frame = part(time_code.code.drop_frame ? 1 : 0);
  message.rate = time_code.rate;
}

void to_msg(std::uint32_t id, const transport::LensEncoders& encoders, trk_bridge::LensEncoders& message) {
  message.id = id;
  message.zoom_known = static_cast<std::uint8_t>(encoders.zoom.has_value());
  message.zoom = encoders.zoom.value_or(0);
  message.focus_known = static_cast<std::uint8_t>(encoders.focus.has_value());
  message.focus = encoders.focus.value_or(0);
  message.iris_known = static_cast<std::uint8_t>(encoders.iris.has_value());
  message.iris = encoders.iris.value_or(0);
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

::ros::Time to_time(std::int64_t nanoseconds) noexcept {
  if (!bridge::can_be_stamp(nanoseconds)) return {};
  ::ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

std::int64_t from_time(const ::ros::Time& time) noexcept { return static_cast<std::int64_t>(time.toNSec()); }

wire::CameraParams from_msg(const Params& message) {
  wire::CameraParams params;
  wire::copy_fields<wire::CameraParams>(message, params);
  if (wire::has(params.format, wire::euler)) {
    wire::copy_fields<wire::Euler>(message, params.euler);
  } else {
    std::copy(message.matrix.begin(), message.matrix.end(), params.matrix.begin());
  }
  return params;
}

wire::CameraConstants from_msg(const trk_bridge::CameraConstants& message) {
  wire::CameraConstants constants;
  wire::copy_fields<wire::CameraConstants>(message, constants);
  return constants;
}

base::TimeCodeWithRate from_msg(const trk_bridge::TimeCode& message) {
  return {{message.hours, message.minutes, message.seconds, message.frames, message.field, message.drop_frame != 0},
          message.rate};
}

}  // namespace trk_bridge::ros1
