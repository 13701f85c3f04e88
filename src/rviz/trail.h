// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The positions of a camera in the last seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ros/time.h>
#include <Eigen/Core>

namespace trk_bridge::rviz_display {

/// Positions by time, in a frame that the caller knows. The length is limited in seconds and in points; a camera at
/// rest adds no points. Throws only if memory is exhausted.
class Trail {
 public:
  struct Point {
    ros::Time time;
    Eigen::Vector3d position;  ///< m
  };
  static constexpr double spacing = 0.002;  ///< m between points, except the last one, which is always the newest
  static constexpr std::size_t most = 4000;

  /// Removes points older than `length` seconds before `time`. Adds nothing if the time is not after that of the last
  /// point, or if the position is not finite. `frame` is the frame whose origin the trail follows: another frame starts
  /// a new trail.
  void add(const ros::Time& time, const std::string& frame, const Eigen::Vector3d& position, double length);

  /// Computes all points again: `position(frame, time)` returns the position in another fixed frame, or none if it is
  /// not known any more.
  template <typename Position>
  void move(Position position) {
    std::vector<Point> moved;
    for (const auto& point : points_) {
      const std::optional<Eigen::Vector3d> now_at = position(frame_, point.time);
      if (now_at) moved.push_back({point.time, *now_at});
    }
    points_ = std::move(moved);
  }

  void clear() { points_.clear(); }
  const std::vector<Point>& points() const { return points_; }

 private:
  std::string frame_;
  std::vector<Point> points_;  // oldest first
};

/// Pairs of points, one per line segment.
std::vector<Eigen::Vector3d> lines_of(const Trail&);

}  // namespace trk_bridge::rviz_display
