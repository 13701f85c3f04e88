// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Poses in the fixed frame of rviz.
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

  /// Whether pose_of() has a result; throws no exception internally if it has none.
  bool knows(const std::string& frame, const ros::Time& time) const;
  /// fixed_T_frame at that time (0: the latest); none if tf does not know it, or if it is not finite.
  std::optional<Eigen::Isometry3d> pose_of(const std::string& frame, const ros::Time& time) const;
  /// The reason why there is none, in the words of tf.
  std::string why_unknown(const std::string& frame, const ros::Time& time) const;

 private:
  rviz::FrameManager& frames_;
};

}  // namespace trk_bridge::rviz_display
