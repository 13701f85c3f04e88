// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trail.h"

#include <algorithm>

#include "samples.h"

namespace trk_bridge::rviz_display {

void Trail::add(const ros::Time& time, const std::string& frame, const Eigen::Vector3d& position, double length) {
  if (frame != frame_) {
    points_.clear();
    frame_ = frame;
  }
  if (!position.allFinite()) return;
  if (points_.empty() || ros1::from_time(time) > ros1::from_time(points_.back().time)) {
    const bool last_may_move = points_.size() >= 2;
    if (last_may_move && (points_.back().position - points_[points_.size() - 2].position).norm() < spacing) {
      points_.back() = {time, position};
    } else {
      points_.push_back({time, position});
    }
  }
  const auto first = std::find_if(points_.begin(), points_.end(), [&](const Point& point) {
    return seconds_between(point.time, points_.back().time) <= length;
  });
  points_.erase(points_.begin(), first);
  if (points_.size() > most) points_.erase(points_.begin(), points_.end() - most);
}

std::vector<Eigen::Vector3d> lines_of(const Trail& trail) {
  std::vector<Eigen::Vector3d> lines;
  const auto& points = trail.points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    lines.push_back(points[i - 1].position);
    lines.push_back(points[i].position);
  }
  return lines;
}

}  // namespace trk_bridge::rviz_display
