// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card_markers.h"

#include <vector>

#include "ros/markers.h"

namespace trk_bridge::demo {
namespace {

using ros1::make_marker;
using ros1::MarkerLook;
using ros1::to_point;

// Coloured and transparent, so that they differ from the grey picture below them, which stays visible.
constexpr float alpha = 0.6F;
constexpr MarkerLook floor_look{visualization_msgs::Marker::LINE_LIST, 0.1F, 0.6F, 1.0F, alpha, 0.012};
constexpr MarkerLook wall_look{visualization_msgs::Marker::LINE_LIST, 0.1F, 0.9F, 0.4F, alpha, 0.012};
constexpr MarkerLook point_look{visualization_msgs::Marker::SPHERE_LIST, 1.0F, 0.3F, 0.1F, alpha, 0.06};
constexpr MarkerLook label_look{visualization_msgs::Marker::TEXT_VIEW_FACING, 1.0F, 0.8F, 0.2F, alpha, 0.12};

visualization_msgs::Marker grid(const char* name, const MarkerLook& look, const std::vector<Line>& lines,
                                const std::string& studio_frame) {
  auto grid = make_marker(name, look, studio_frame);
  for (const Line& line : lines) {
    grid.points.push_back(to_point(line.from));
    grid.points.push_back(to_point(line.to));
  }
  return grid;
}

}  // namespace

visualization_msgs::MarkerArray markers_of(const Figure& figure, const std::string& studio_frame) {
  visualization_msgs::MarkerArray markers;
  markers.markers.push_back(grid("floor", floor_look, figure.floor, studio_frame));
  markers.markers.push_back(grid("wall", wall_look, figure.wall, studio_frame));
  auto points = make_marker("points", point_look, studio_frame);
  std::vector<visualization_msgs::Marker> labels;
  for (const Point& point : figure.points) {
    points.points.push_back(to_point(point.place));
    if (point.label.empty()) continue;
    auto label = make_marker("labels", label_look, studio_frame);
    label.id = static_cast<int>(labels.size());
    label.text = point.label;
    label.pose.position = to_point(point.place + Eigen::Vector3d(0, 0, label_look.size));
    labels.push_back(label);
  }
  markers.markers.push_back(points);
  markers.markers.insert(markers.markers.end(), labels.begin(), labels.end());
  return markers;
}

}  // namespace trk_bridge::demo
