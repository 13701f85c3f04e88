// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "crane_motion.h"

#include <cmath>
#include <cstddef>

namespace trk_bridge::demo {
namespace {

constexpr double radians(double degrees) { return degrees * M_PI / 180; }

// Dimensions of the URDF, in metres.
const Eigen::Vector3d pivot(-2, -3, 1.5);  // of the arm, in the studio
constexpr double arm_length = 5;           // from the pivot to the mount, retracted
constexpr double head_below_mount = 0.7;   // where the axes of pan, tilt and roll meet
constexpr double projection_ahead = 0.12;  // from there to the centre of projection, along the optical axis

/// A position of the shot at which the crane rests briefly.
struct Mark {
  double pan, elevation;  // degrees
  double extension;       // m
  double roll;            // degrees
  double zoom;            // mm, image distance
  double target[3];       // m in the studio
};

// High and wide over the stage; down to the presenter; close-up with a little roll; up again with the arm retracted.
constexpr Mark marks[] = {
    {38, 26, 2.6, 0, 9, {0, 9, 0.8}},
    {6, 6, 3.4, 0, 16, {0.5, 9.5, 1.5}},
    {-34, -2, 2.0, -8, 46, {0.8, 9.5, 1.6}},
    {-12, 14, 0.4, 5, 24, {-1.5, 10, 1.4}},
};
constexpr double seconds_between_marks = shot_duration / std::size(marks);

/// From 0 to 1, with velocity and acceleration 0 at both.
double eased(double u) { return u * u * u * (10 + u * (6 * u - 15)); }

double between(double from, double to, double part) { return from + (to - from) * part; }

struct Place {
  double pan, elevation, extension, roll, image_distance;
  Eigen::Vector3d target;
};

Place place_at(double seconds) {
  const double in_shot = seconds - std::floor(seconds / shot_duration) * shot_duration;
  const double passed = in_shot / seconds_between_marks;
  const auto leg = static_cast<std::size_t>(passed);
  const Mark& from = marks[leg % std::size(marks)];
  const Mark& to = marks[(leg + 1) % std::size(marks)];
  const double part = eased(passed - static_cast<double>(leg));
  Place place;
  place.pan = radians(between(from.pan, to.pan, part));
  place.elevation = radians(between(from.elevation, to.elevation, part));
  place.extension = between(from.extension, to.extension, part);
  place.roll = radians(between(from.roll, to.roll, part));
  // The logarithm of the image distance is interpolated: this looks even.
  place.image_distance = std::exp(between(std::log(from.zoom), std::log(to.zoom), part));
  place.target = Eigen::Vector3d(from.target) + part * (Eigen::Vector3d(to.target) - Eigen::Vector3d(from.target));
  return place;
}

Eigen::Vector3d head_of(const Place& place) {
  const double length = arm_length + place.extension;
  const double reach = length * std::cos(place.elevation);
  return pivot + Eigen::Vector3d(-std::sin(place.pan) * reach, std::cos(place.pan) * reach,
                                 length * std::sin(place.elevation) - head_below_mount);
}

camera::Lens lens_at(double image_distance, double focus_distance) {
  constexpr double widest = 8;  // mm
  const double wide = widest / image_distance;
  camera::Lens lens;
  lens.image_distance = image_distance;
  // As in every lens, the optical axis moves on the chip with the zoom, and barrel distortion at the wide end becomes a
  // little pincushion distortion at the long end.
  lens.center_shift = {0.012 + 0.02 * wide, -0.008 + 0.015 * wide * wide};
  lens.k1 = 1.8e-3 * wide * wide - 1.2e-4;
  lens.k2 = 4e-6 * wide * wide;
  lens.focdist = focus_distance;
  lens.aperture = 4;
  return lens;
}

}  // namespace

Moment moment_at(double seconds) noexcept {
  const Place place = place_at(seconds);
  const Eigen::Vector3d sight = place.target - head_of(place);
  const double head_pan = std::atan2(-sight.x(), sight.y()) - place.pan;
  const double head_tilt = std::atan2(sight.z(), std::hypot(sight.x(), sight.y()));

  Moment moment;
  moment.joints = {place.pan, place.elevation, place.extension, head_pan, head_tilt, place.roll};
  moment.lens = lens_at(place.image_distance, sight.norm() - projection_ahead);
  moment.target = place.target;
  return moment;
}

wire::CameraConstants camera_constants() noexcept {
  wire::CameraConstants constants;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.chip_width = constants.fake_chip_width = 9.59;
  constants.chip_height = constants.fake_chip_height = 5.39;
  return constants;
}

}  // namespace trk_bridge::demo
