#include "crane_move.h"

#include <cmath>

namespace trk_bridge::tools {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * pi / 180.0; }

/// -1 to 1 and back in `period` seconds, `phase` periods ahead.
double wave(double seconds, double period, double phase) { return std::sin(2.0 * pi * (seconds / period + phase)); }

Eigen::Vector3d arm_end(double seconds) {
  const double pan = radians(crane::swing) * wave(seconds, 24.0, 0.0);
  const double elevation = radians(crane::mean_elevation) + radians(crane::lift) * wave(seconds, 17.0, 0.2);
  const Eigen::Vector3d arm(-std::sin(pan) * std::cos(elevation), std::cos(pan) * std::cos(elevation),
                            std::sin(elevation));
  return crane::pivot() + crane::arm_length * arm;
}

/// Even to the eye: the logarithm of the image distance swings.
double image_distance(double seconds) {
  const double ratio = crane::longest_image_distance / crane::shortest_image_distance;
  return crane::shortest_image_distance * std::pow(ratio, 0.5 + 0.5 * wave(seconds, 31.0, -0.25));
}

camera::Lens lens_at(double seconds, double focus_distance) {
  camera::Lens lens;
  lens.image_distance = image_distance(seconds);
  const double wide = crane::shortest_image_distance / lens.image_distance;
  // The optical axis wanders over the chip with the zoom, as it does in every lens.
  lens.center_shift = {0.012 + 0.02 * wide, -0.008 + 0.015 * wide * wide};
  lens.k1 = 1.8e-3 * wide * wide - 1.2e-4;
  lens.k2 = 4e-6 * wide * wide;
  lens.focdist = focus_distance;
  lens.aperture = 4.0;
  return lens;
}

}  // namespace

camera::Camera crane_camera(double seconds) noexcept {
  const Eigen::Vector3d position = arm_end(seconds);
  const Eigen::Vector3d sight = crane::target() - position;
  const double distance = sight.norm();
  camera::PanTiltRoll head;
  head.pan = std::atan2(-sight.x(), sight.y()) * 180.0 / pi;
  head.tilt = std::atan2(sight.z(), std::hypot(sight.x(), sight.y())) * 180.0 / pi;

  camera::Camera result;
  result.pose.translation() = position;
  result.pose.linear() = camera::rotation_of(head);
  result.lens = lens_at(seconds, distance);
  return result;
}

wire::CameraConstants crane_constants() noexcept {
  wire::CameraConstants constants;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.chip_width = constants.fake_chip_width = 9.59;
  constants.chip_height = constants.fake_chip_height = 5.39;
  return constants;
}

}  // namespace trk_bridge::tools
