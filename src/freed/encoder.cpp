// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "encoder.h"

#include <cmath>
#include <utility>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::freed {
namespace {

using transport::Fault;

/// Counts of a full turn.
constexpr double turn = 360 * per_degree;

bool fits(double number) noexcept { return number >= least && number <= most; }

/// The angle, wrapped to -180..180 degrees if it does not fit into the message.
double within_reach(double degrees) noexcept {
  return fits(std::round(degrees * per_degree)) ? degrees : std::remainder(degrees, 360.0);
}

/// The same angle, as close to `before` as possible within the range of the message.
std::int32_t unwrapped(std::int32_t pan, std::int32_t before) noexcept {
  double best = pan;
  for (const double other : {pan - turn, pan + turn}) {
    if (fits(other) && std::abs(other - before) < std::abs(best - before)) best = other;
  }
  return static_cast<std::int32_t>(best);
}

}  // namespace

tl::expected<void, Fault> Encoder::begin(const wire::CameraConstants& constants) noexcept {
  has_datagram_ = false;
  if (constants.id >= cameras_.size()) return tl::make_unexpected(no_camera_number());
  auto& converter = cameras_[constants.id].converter;
  if (converter.use(constants) == camera::ConstantsChange::invalid) {
    return tl::make_unexpected(no_camera(camera::CameraReason::bad_constants));
  }
  return {};
}

tl::expected<void, Fault> Encoder::begin(const wire::CameraParams& params) noexcept {
  has_datagram_ = false;
  if (params.id == 0 || params.id >= cameras_.size()) return tl::make_unexpected(no_camera_number());
  Camera& camera = cameras_[params.id];
  const auto converted = camera.converter.convert(params);
  if (!converted.pose) return tl::make_unexpected(no_camera(converted.pose.error()));
  if (!converted.lens) return tl::make_unexpected(no_camera(converted.lens.error()));

  wire::Euler pose = params.euler;
  if (!wire::has(params.format, wire::euler) || wire::has(params.format, wire::studio_y_up)) {
    const auto angles = camera::pan_tilt_roll(converted.pose->linear());
    const auto& at = converted.pose->translation();
    pose = {at.x(), at.y(), at.z(), angles.pan, angles.tilt, angles.roll};
  }
  Message message;
  message.camera = static_cast<std::uint8_t>(params.id);
  if (const auto done = set_pose(pose, camera, message); !done) return done;
  if (const auto done = set_optics(*converted.lens, message); !done) return done;
  set_frame(camera.frames++, options_.profile, message);
  camera.pan = message.pan;
  bytes_ = bytes_of(message);
  has_datagram_ = true;
  return {};
}

std::optional<std::string_view> Encoder::next() noexcept {
  if (!std::exchange(has_datagram_, false)) return std::nullopt;
  return std::string_view(bytes_.data(), bytes_.size());
}

tl::expected<void, Fault> Encoder::set_pose(const wire::Euler& pose, const Camera& camera,
                                            Message& message) const noexcept {
  struct Number {
    Field field;
    double value, per_unit;
    std::int32_t& to;
  };
  const double pan = options_.unwrap ? within_reach(-pose.pan) : std::remainder(-pose.pan, 360.0);
  const Number numbers[] = {{Field::pan, pan, per_degree, message.pan},
                            {Field::tilt, within_reach(pose.tilt), per_degree, message.tilt},
                            {Field::roll, within_reach(pose.roll), per_degree, message.roll},
                            {Field::x, pose.x, per_metre, message.x},
                            {Field::y, pose.y, per_metre, message.y},
                            {Field::z, pose.z, per_metre, message.z}};
  for (const Number& number : numbers) {
    const double rounded = std::round(number.value * number.per_unit);
    if (!fits(rounded)) return tl::make_unexpected(out_of_range(number.field));
    number.to = static_cast<std::int32_t>(rounded);
  }
  if (options_.unwrap && camera.pan) message.pan = unwrapped(message.pan, *camera.pan);
  return {};
}

tl::expected<void, Fault> Encoder::set_optics(const camera::Lens& lens, Message& message) const noexcept {
  if (options_.table) {
    const auto position = options_.table->position_of(lens);
    if (!position) return tl::make_unexpected(beyond_lens_table());
    transport::LensEncoders encoders;
    encoders.zoom = static_cast<std::int32_t>(std::lround(position->zoom));
    encoders.focus = static_cast<std::int32_t>(std::lround(position->focus));
    return set_encoders(encoders, options_.profile, message);
  }
  if (sends_lens(options_.profile)) return set_lens(lens, message);
  return set_encoders({}, options_.profile, message);
}

}  // namespace trk_bridge::freed
