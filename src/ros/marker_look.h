// What markers have in common, whatever they show.
#pragma once

#include <string>

#include <geometry_msgs/Point.h>
#include <visualization_msgs/Marker.h>
#include <Eigen/Core>

namespace trk_bridge::ros1 {

/// What markers of one kind have in common.
struct MarkerLook {
  int type = visualization_msgs::Marker::LINE_LIST;
  float red = 0, green = 0, blue = 0, alpha = 1;  ///< 0..1
  double size = 1;  ///< m: a line's width, a point's diameter, a letter's height; 1 for triangles
};

/// A marker to be added, with id 0, at the origin of `frame` and without points; unstamped.
visualization_msgs::Marker make_marker(const std::string& name_space, const MarkerLook&, const std::string& frame);

/// m.
geometry_msgs::Point to_point(const Eigen::Vector3d&);

}  // namespace trk_bridge::ros1
