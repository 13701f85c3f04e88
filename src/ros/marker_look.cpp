#include "marker_look.h"

namespace trk_bridge::ros1 {

visualization_msgs::Marker make_marker(const std::string& name_space, const MarkerLook& look,
                                       const std::string& frame) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.ns = name_space;
  marker.type = look.type;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = look.size;
  marker.color.r = look.red;
  marker.color.g = look.green;
  marker.color.b = look.blue;
  marker.color.a = look.alpha;
  return marker;
}

geometry_msgs::Point to_point(const Eigen::Vector3d& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = place.z();
  return point;
}

}  // namespace trk_bridge::ros1
