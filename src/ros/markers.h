// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Markers: common functions, and a camera drawn with markers, for viewers without plugins.
#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/Point.h>
#include <sensor_msgs/CameraInfo.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>
#include <Eigen/Core>

#include "bridge/camera_info.h"
#include "bridge/diagnostics.h"
#include "camera/figure.h"

namespace trk_bridge::ros1 {

/// The look of markers of one kind.
struct MarkerLook {
  int type = visualization_msgs::Marker::LINE_LIST;
  float red = 0, green = 0, blue = 0, alpha = 1;  ///< 0..1
  double size = 1;  ///< m: width of a line, diameter of a point, height of a letter; 1 for triangles
};

/// A marker with action ADD and id 0, at the origin of `frame`, without points and without stamp.
visualization_msgs::Marker make_marker(const std::string& name_space, const MarkerLook&, const std::string& frame);

/// In metres.
geometry_msgs::Point to_point(const Eigen::Vector3d&);

/// Where the frustum begins, m.
inline constexpr double marker_near = 0.2;

/// A camera as markers: frustum, optical axis, plane in focus, name. Makes four markers for every sample, each with id
/// 0 and its own namespace: `<camera>/frustum` (LINE_LIST, marker_near to `far`), `<camera>/axis` (LINE_LIST, to
/// `far`), `<camera>/focus` (TRIANGLE_LIST) and `<camera>/name` (TEXT_VIEW_FACING, above the camera). They are in m, in
/// the optical frame at their stamp, and do not move with it afterwards. What cannot be drawn has the action DELETE:
/// the plane in focus if camera::draws_focus(focdist) is false, all markers if the lens cannot be drawn. Not
/// synchronised. The border is computed only when the lens changes.
class CameraMarkers {
 public:
  /// `far` (m) is more than marker_near; markers disappear `lifetime` seconds after the last ones were received.
  CameraMarkers(const std::string& camera, const std::string& optical_frame, double far, double lifetime);

  /// The markers of a sample, with the stamp of `info`. `focdist` in m.
  const visualization_msgs::MarkerArray& draw(const sensor_msgs::CameraInfo& info, double focdist);
  /// All four markers with action DELETE.
  const visualization_msgs::MarkerArray& remove(const ::ros::Time& stamp);
  /// Whether anything is visible after the last call.
  bool visible() const noexcept { return visible_; }

  const bridge::MarkerStatistics& statistics() const noexcept { return statistics_; }

 private:
  void update_lens();
  void update_focus(double focdist);
  void stamp(const ::ros::Time&);

  double far_;
  bool visible_ = false;
  bridge::CameraInfo info_;                  // the newest one
  std::optional<bridge::CameraInfo> known_;  // the one whose border or fault is known
  std::optional<camera::ImageBorder> border_;
  double focdist_ = 0;  ///< of the drawn plane
  visualization_msgs::MarkerArray markers_;
  bridge::MarkerStatistics statistics_;
};

}  // namespace trk_bridge::ros1
