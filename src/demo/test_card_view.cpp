// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_view.h"

#include <algorithm>
#include <cmath>

namespace trk_bridge::demo {
namespace {

/// m in front of the centre of projection; nearer parts are not drawn.
constexpr double near_plane = 0.02;

/// The slope of the polynomial is 0 at the fold; a picture of that region would be arbitrary.
constexpr double clear_of_the_fold = 0.999;

/// Pixels beyond the image that are also computed, because lines and discs have a width.
constexpr double margin = 32;

constexpr double longest_chord = 64;  // pixels: shorter chords cannot hide a curve and an opposite curve
constexpr int most_halvings = 12;

/// The part of from..to (0..1) within a circle around the origin; none if it misses the circle.
std::optional<std::pair<double, double>> within_circle(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                                       double radius) {
  const Eigen::Vector2d along = to - from;
  const double length = along.stableNorm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::Vector2d direction = along / length;
  const double nearest = -from.dot(direction);
  const double beside = (from + nearest * direction).stableNorm();
  if (!(beside < radius)) return std::nullopt;
  const double half = std::sqrt((radius - beside) * (radius + beside));
  const double begin = std::max(0.0, (nearest - half) / length), end = std::min(1.0, (nearest + half) / length);
  if (!(begin < end)) return std::nullopt;
  return std::pair{begin, end};
}

double beside_chord(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d chord = to - from;
  const double length = chord.norm();
  if (!(length > 0)) return (point - from).norm();
  const Eigen::Vector2d offset = point - from;
  return std::abs(chord.x() * offset.y() - chord.y() * offset.x()) / length;
}

}  // namespace

camera::Result<View> View::of(const wire::CameraParams& params, const wire::CameraConstants& constants) {
  if (const auto checked = camera::check(constants); !checked) return tl::unexpected(checked.error());
  const auto camera = camera::decode(params, &constants);
  if (!camera) return tl::unexpected(camera.error());
  return View(*camera, camera::raster_of(constants));
}

View::View(const camera::Camera& camera, const camera::Raster& raster)
    : camera_T_studio_(camera.pose.inverse()), lens_(camera.lens), raster_(raster) {
  const double reach = std::min(camera::image_reach(lens_, raster_) + margin / std::min(raster_.mx, raster_.my),
                                clear_of_the_fold * camera::monotonic_radius(lens_));
  undistorted_reach_ =
      (camera::undistort(lens_, Eigen::Vector2d(reach, 0) - lens_.center_shift) + lens_.center_shift).norm();
}

bool View::within_lens(const Eigen::Vector2d& undistorted) const {
  return (undistorted + lens_.center_shift).stableNorm() <= undistorted_reach_;
}

std::optional<Eigen::Vector2d> View::pixel(const Eigen::Vector2d& undistorted) const {
  const auto distorted = camera::distort(lens_, undistorted);
  if (!distorted) return std::nullopt;
  return camera::to_pixel(raster_, *distorted);
}

std::optional<Eigen::Vector2d> View::see(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d before_camera = camera_T_studio_ * point;
  if (!(before_camera.y() >= near_plane)) return std::nullopt;
  const auto undistorted = camera::project(lens_, before_camera);
  if (!undistorted || !within_lens(*undistorted)) return std::nullopt;
  return pixel(*undistorted);
}

void View::see(const Line& line, Polyline& seen) const {
  seen.clear();
  Eigen::Vector3d from = camera_T_studio_ * line.from, to = camera_T_studio_ * line.to;
  if (from.y() > to.y()) std::swap(from, to);
  if (!(to.y() > near_plane)) return;
  if (from.y() < near_plane) from += (near_plane - from.y()) / (to.y() - from.y()) * (to - from);
  const auto begin = camera::project(lens_, from), end = camera::project(lens_, to);
  if (!begin || !end) return;
  // Before distortion the line is straight, and the limit of the lens is a circle.
  const auto part = within_circle(*begin + lens_.center_shift, *end + lens_.center_shift, undistorted_reach_);
  if (!part) return;
  const Eigen::Vector2d along = *end - *begin;
  bend(*begin + part->first * along, *begin + part->second * along, seen);
}

void View::bend(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Polyline& seen) const {
  struct End {
    Eigen::Vector2d undistorted, pixel;
    int halvings;
  };
  const auto begin = pixel(from), end = pixel(to);
  if (!begin || !end) return;
  seen.push_back(*begin);
  Eigen::Vector2d behind = from;
  // Ends of parts that are still to be drawn, the next one last.
  std::vector<End> ahead{{to, *end, 0}};
  while (!ahead.empty()) {
    const End next = ahead.back();
    const Eigen::Vector2d middle = (behind + next.undistorted) / 2;
    const auto middle_pixel = pixel(middle);
    const bool straight = middle_pixel && (next.pixel - seen.back()).norm() <= longest_chord &&
                          beside_chord(*middle_pixel, seen.back(), next.pixel) <= chord_tolerance;
    if (straight || !middle_pixel || next.halvings == most_halvings) {
      seen.push_back(next.pixel);
      behind = next.undistorted;
      ahead.pop_back();
    } else {
      ahead.back().halvings = next.halvings + 1;
      ahead.push_back({middle, *middle_pixel, next.halvings + 1});
    }
  }
}

}  // namespace trk_bridge::demo
