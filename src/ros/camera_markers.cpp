#include "trk_bridge/ros/camera_markers.h"

#include <vector>

namespace trk_bridge::ros1 {
namespace {

using visualization_msgs::Marker;

/// Places in MarkerArray::markers.
enum Place : std::size_t { frustum, axis, focus, name, count };

struct Look {
  const char* name_space;
  int type;
  float red, green, blue, alpha;
  double size;  ///< m: a line's width, a letter's height, 1 for triangles
};

constexpr Look looks[] = {{"/frustum", Marker::LINE_LIST, 1.0F, 0.667F, 0.0F, 1.0F, 0.01},
                          {"/axis", Marker::LINE_LIST, 1.0F, 0.25F, 0.25F, 1.0F, 0.01},
                          {"/focus", Marker::TRIANGLE_LIST, 0.25F, 0.75F, 1.0F, 0.3F, 1.0},
                          {"/name", Marker::TEXT_VIEW_FACING, 1.0F, 1.0F, 1.0F, 1.0F, 0.15}};
constexpr double name_above_the_camera = 0.25;  // m

Marker make_marker(const Look& look, const std::string& camera, const std::string& frame, double lifetime) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.ns = camera + look.name_space;
  marker.type = look.type;
  marker.action = Marker::DELETE;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = look.size;
  marker.color.r = look.red;
  marker.color.g = look.green;
  marker.color.b = look.blue;
  marker.color.a = look.alpha;
  marker.lifetime.fromSec(lifetime);
  return marker;
}

geometry_msgs::Point to_msg(const Eigen::Vector3d& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = place.z();
  return point;
}

void set_points(const std::vector<Eigen::Vector3d>& places, Marker& marker) {
  marker.points.clear();
  for (const auto& place : places) marker.points.push_back(to_msg(place));
}

}  // namespace

CameraMarkers::CameraMarkers(const std::string& camera, const std::string& optical_frame, double far, double lifetime)
    : far_(far) {
  for (const Look& look : looks) markers_.markers.push_back(make_marker(look, camera, optical_frame, lifetime));
  set_points({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ() * far}, markers_.markers[axis]);
  markers_.markers[name].text = camera;
  markers_.markers[name].pose.position.y = -name_above_the_camera;
}

const visualization_msgs::MarkerArray& CameraMarkers::draw(const sensor_msgs::CameraInfo& info, double focdist) {
  if (!info_ || !same_calibration(info, *info_)) take_lens(info);
  if (!border_) {
    ++statistics_.not_drawn;
    return remove(info.header.stamp);
  }
  visible_ = true;
  for (const Place place : {frustum, axis, name}) markers_.markers[place].action = Marker::ADD;
  take_focus(focdist);
  stamp(info.header.stamp);
  return markers_;
}

const visualization_msgs::MarkerArray& CameraMarkers::remove(const ::ros::Time& time) {
  visible_ = false;
  for (Marker& marker : markers_.markers) marker.action = Marker::DELETE;
  stamp(time);
  return markers_;
}

void CameraMarkers::take_lens(const sensor_msgs::CameraInfo& info) {
  info_ = info;
  border_.reset();
  focdist_ = 0;
  for (const Place place : {frustum, focus}) markers_.markers[place].points.clear();
  const auto lens = viewing_lens(info);
  if (!lens) {
    statistics_.reason = lens.error();
    return;
  }
  const auto border = camera::image_border(*lens);
  if (!border) {
    statistics_.reason = {InfoReason::no_lens, border.error()};
    return;
  }
  border_ = *border;
  set_points(camera::frustum_lines(*border_, marker_near, far_), markers_.markers[frustum]);
}

void CameraMarkers::take_focus(double focdist) {
  Marker& plane = markers_.markers[focus];
  if (!camera::draws_focus(focdist)) {
    plane.action = Marker::DELETE;
    return;
  }
  plane.action = Marker::ADD;
  if (focdist == focdist_) return;
  set_points(camera::area_at(*border_, focdist), plane);
  focdist_ = focdist;
}

void CameraMarkers::stamp(const ::ros::Time& time) {
  for (Marker& marker : markers_.markers) marker.header.stamp = time;
}

}  // namespace trk_bridge::ros1
