// Where a camera was in the last seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ros/time.h>
#include <Eigen/Core>

namespace trk_bridge::rviz_display {

/// Positions by time, in a frame that the caller knows. Its length is bounded in seconds and in points; a camera at
/// rest adds none. Nothing here throws but for want of memory.
class Trail {
 public:
  struct Point {
    ros::Time time;
    Eigen::Vector3d position;  ///< m
  };
  static constexpr double spacing = 0.002;  ///< m between points, except for the last, which is always the newest
  static constexpr std::size_t most = 4000;

  /// Points older than `length` seconds before `time` are forgotten. A time that is not after the last one's, or a
  /// position that is not finite, adds nothing; `frame` is the one whose origin the trail follows: another one starts a
  /// new trail.
  void add(const ros::Time& time, const std::string& frame, const Eigen::Vector3d& position, double length);

  /// Every point is asked for again: `position(frame, time)` gives it in another fixed frame, or nothing where it is
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

/// Pairs of points, a line segment each.
std::vector<Eigen::Vector3d> lines_of(const Trail&);

}  // namespace trk_bridge::rviz_display
