// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tracked_camera.h"

#include <cmath>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::test {
namespace {

double radians(double degrees) { return degrees * std::acos(-1.0) / 180; }

}  // namespace

TrackedCamera plain_camera(double x, double pan) {
  TrackedCamera camera;
  camera.constants.image_width = 1920;
  camera.constants.image_height = 1080;
  camera.constants.chip_width = camera.constants.fake_chip_width = 9.6;
  camera.constants.chip_height = camera.constants.fake_chip_height = 5.4;
  camera.params.format = wire::euler;
  camera.params.euler = {x, -0.5, 1.2, pan, -5, 0};
  camera.params.fov = 9;
  camera.params.focdist = 2;
  return camera;
}

Eigen::Isometry3d pose_of(const TrackedCamera& camera) {
  const auto& e = camera.params.euler;
  return Eigen::Translation3d(e.x, e.y, e.z) * Eigen::AngleAxisd(radians(e.pan), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(radians(e.tilt), Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(radians(e.roll), Eigen::Vector3d::UnitY());
}

Eigen::Vector3d seen_at(const TrackedCamera& camera, const Eigen::Vector2d& image, double depth) {
  const auto& c = camera.constants;
  const auto& p = camera.params;
  const double picture_width = c.image_width - c.blank_left - c.blank_right;
  const double picture_height = c.image_height - c.blank_top - c.blank_bottom;
  const Eigen::Vector2d on_chip(
      (image.x() - c.blank_left - picture_width / 2) * c.chip_width / picture_width,
      (c.image_height - image.y() - c.blank_bottom - picture_height / 2) * c.chip_height / picture_height);
  const Eigen::Vector2d off_axis = on_chip + Eigen::Vector2d(p.center_x, p.center_y);
  const double r2 = off_axis.squaredNorm();
  const Eigen::Vector2d straight = (1 + p.k1 * r2 + p.k2 * r2 * r2) * off_axis / p.fov;
  return pose_of(camera) * (depth * Eigen::Vector3d(straight.x(), 1, straight.y()));
}

Path outline(const TrackedCamera& camera, double depth) {
  constexpr int points_an_edge = 50;
  const Eigen::Vector2d size(camera.constants.image_width, camera.constants.image_height);
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {size.x(), 0}, size, {0, size.y()}, {0, 0}};
  Path path;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    for (int k = 0; k < points_an_edge; ++k) {
      const Eigen::Vector2d at = corners[i] + (corners[i + 1] - corners[i]) * k / points_an_edge;
      path.push_back(seen_at(camera, at, depth));
    }
  }
  path.push_back(path.front());
  return path;
}

std::vector<Path> frustum(const TrackedCamera& camera, double near, double far) {
  std::vector<Path> paths{outline(camera, near), outline(camera, far)};
  for (const double x : {0, camera.constants.image_width}) {
    for (const double y : {0, camera.constants.image_height}) {
      paths.push_back({seen_at(camera, {x, y}, near), seen_at(camera, {x, y}, far)});
    }
  }
  return paths;
}

std::vector<Polyline> seen_by(const OrbitView& view, const std::vector<Path>& paths) {
  std::vector<Polyline> lines;
  for (const auto& path : paths) {
    lines.emplace_back();
    for (const auto& point : path) lines.back().push_back(view.shows_at(point));
  }
  return lines;
}

}  // namespace trk_bridge::test
