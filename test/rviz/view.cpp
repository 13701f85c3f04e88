// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "view.h"

#include <cmath>

namespace trk_bridge::test {

OrbitView::OrbitView(const Place& place, const Eigen::Vector2d& size) : size_(size) {
  const Eigen::Vector3d outwards(std::cos(place.yaw) * std::cos(place.pitch),
                                 std::sin(place.yaw) * std::cos(place.pitch), std::sin(place.pitch));
  position_ = place.focal_point + place.distance * outwards;
  forward_ = -outwards;
  right_ = forward_.cross(Eigen::Vector3d::UnitZ()).normalized();
  up_ = right_.cross(forward_);
  pixels_a_unit_ = size.y() / 2 / std::tan(place.field_of_view / 2);
}

Eigen::Vector2d OrbitView::shows_at(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d ray = point - position_;
  const double depth = ray.dot(forward_);
  return size_ / 2 + pixels_a_unit_ / depth * Eigen::Vector2d(ray.dot(right_), -ray.dot(up_));
}

bool OrbitView::contains(const Eigen::Vector2d& pixel) const {
  return (pixel.array() >= 0).all() && (pixel.array() < size_.array()).all();
}

}  // namespace trk_bridge::test
