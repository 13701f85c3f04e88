// Poses in rviz's fixed frame.
#pragma once

#include <optional>
#include <string>

#include <ros/time.h>
#include <Eigen/Geometry>

namespace rviz {
class FrameManager;
}

namespace trk_bridge::rviz_display {

/// A view of tf for one rendered frame.
class FixedFrame {
 public:
  explicit FixedFrame(rviz::FrameManager& frames) : frames_(frames) {}

  /// Whether pose_of() has an answer; costs no exception where it has none.
  bool knows(const std::string& frame, const ros::Time& time) const;
  /// fixed_T_frame at that time (0: the latest), nothing where tf does not know it or it is not finite.
  std::optional<Eigen::Isometry3d> pose_of(const std::string& frame, const ros::Time& time) const;
  /// Why there is none, in tf's own words.
  std::string why_unknown(const std::string& frame, const ros::Time& time) const;

 private:
  rviz::FrameManager& frames_;
};

}  // namespace trk_bridge::rviz_display
