#include "test_card_markers.h"

#include <vector>

namespace trk_bridge::test_card {
namespace {

struct Look {
  const char* name_space;
  int type;
  float red, green, blue;
  double size;  // m: a line's width, a point's diameter, a letter's height
};

// Not grey, so that they are told from the picture that they are laid over.
constexpr Look floor_look{"floor", visualization_msgs::Marker::LINE_LIST, 0.1F, 0.6F, 1.0F, 0.012};
constexpr Look wall_look{"wall", visualization_msgs::Marker::LINE_LIST, 0.1F, 0.9F, 0.4F, 0.012};
constexpr Look point_look{"points", visualization_msgs::Marker::SPHERE_LIST, 1.0F, 0.3F, 0.1F, 0.06};
constexpr Look label_look{"labels", visualization_msgs::Marker::TEXT_VIEW_FACING, 1.0F, 0.8F, 0.2F, 0.12};

visualization_msgs::Marker marker(const Look& look, const std::string& studio_frame) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = studio_frame;
  marker.ns = look.name_space;
  marker.type = look.type;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = look.size;
  marker.color.r = look.red;
  marker.color.g = look.green;
  marker.color.b = look.blue;
  marker.color.a = 0.6F;  // the picture shows through
  return marker;
}

geometry_msgs::Point to_msg(const Eigen::Vector3d& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = place.z();
  return point;
}

visualization_msgs::Marker grid(const Look& look, const std::vector<Line>& lines, const std::string& studio_frame) {
  auto grid = marker(look, studio_frame);
  for (const Line& line : lines) {
    grid.points.push_back(to_msg(line.from));
    grid.points.push_back(to_msg(line.to));
  }
  return grid;
}

}  // namespace

visualization_msgs::MarkerArray markers_of(const Figure& figure, const std::string& studio_frame) {
  visualization_msgs::MarkerArray markers;
  markers.markers.push_back(grid(floor_look, figure.floor, studio_frame));
  markers.markers.push_back(grid(wall_look, figure.wall, studio_frame));
  auto points = marker(point_look, studio_frame);
  std::vector<visualization_msgs::Marker> labels;
  for (const Point& point : figure.points) {
    points.points.push_back(to_msg(point.place));
    if (point.label.empty()) continue;
    auto label = marker(label_look, studio_frame);
    label.id = static_cast<int>(labels.size());
    label.text = point.label;
    label.pose.position = to_msg(point.place + Eigen::Vector3d(0, 0, label_look.size));
    labels.push_back(label);
  }
  markers.markers.push_back(points);
  markers.markers.insert(markers.markers.end(), labels.begin(), labels.end());
  return markers;
}

}  // namespace trk_bridge::test_card
