// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "markers.h"

#include <vector>

#include "camera_info.h"

namespace trk_bridge::ros1 {
namespace {

using visualization_msgs::Marker;

/// Indices of MarkerArray::markers.
enum Place : std::size_t { frustum, axis, focus, name, count };

struct Look {
  const char* name_space;
  MarkerLook marker;
};

constexpr Look looks[] = {{"/frustum", {Marker::LINE_LIST, 1.0F, 0.667F, 0.0F, 1.0F, 0.01}},
                          {"/axis", {Marker::LINE_LIST, 1.0F, 0.25F, 0.25F, 1.0F, 0.01}},
                          {"/focus", {Marker::TRIANGLE_LIST, 0.25F, 0.75F, 1.0F, 0.3F, 1.0}},
                          {"/name", {Marker::TEXT_VIEW_FACING, 1.0F, 1.0F, 1.0F, 1.0F, 0.15}}};
constexpr double name_above_the_camera = 0.25;  // m

void set_points(const std::vector<Eigen::Vector3d>& places, Marker& marker) {
  marker.points.clear();
  for (const auto& place : places) marker.points.push_back(to_point(place));
}

}  // namespace

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

CameraMarkers::CameraMarkers(const std::string& camera, const std::string& optical_frame, double far, double lifetime)
    : far_(far) {
  for (const Look& look : looks) {
    Marker marker = make_marker(camera + look.name_space, look.marker, optical_frame);
    marker.action = Marker::DELETE;
    marker.lifetime.fromSec(lifetime);
    markers_.markers.push_back(marker);
  }
  set_points({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ() * far}, markers_.markers[axis]);
  markers_.markers[name].text = camera;
  markers_.markers[name].pose.position.y = -name_above_the_camera;
}

const visualization_msgs::MarkerArray& CameraMarkers::draw(const sensor_msgs::CameraInfo& info, double focdist) {
  from_msg(info, info_);
  if (!known_ || !same_calibration(info_, *known_)) update_lens();
  if (!border_) {
    ++statistics_.not_drawn;
    return remove(info.header.stamp);
  }
  visible_ = true;
  for (const Place place : {frustum, axis, name}) markers_.markers[place].action = Marker::ADD;
  update_focus(focdist);
  stamp(info.header.stamp);
  return markers_;
}

const visualization_msgs::MarkerArray& CameraMarkers::remove(const ::ros::Time& time) {
  visible_ = false;
  for (Marker& marker : markers_.markers) marker.action = Marker::DELETE;
  stamp(time);
  return markers_;
}

void CameraMarkers::update_lens() {
  known_ = info_;
  border_.reset();
  focdist_ = 0;
  for (const Place place : {frustum, focus}) markers_.markers[place].points.clear();
  const auto lens = viewing_lens(info_);
  if (!lens) {
    statistics_.reason = lens.error();
    return;
  }
  const auto border = camera::image_border(*lens);
  if (!border) {
    statistics_.reason = {bridge::InfoReason::no_lens, border.error()};
    return;
  }
  border_ = *border;
  set_points(camera::frustum_lines(*border_, marker_near, far_), markers_.markers[frustum]);
}

void CameraMarkers::update_focus(double focdist) {
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
