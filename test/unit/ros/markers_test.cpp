// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A camera as markers.
#include "ros/markers.h"

#include <limits>
#include <map>

#include <gmock/gmock.h>

namespace trk_bridge::ros1::markers_test {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

sensor_msgs::CameraInfo some_info() {
  sensor_msgs::CameraInfo info;
  info.header.stamp = ::ros::Time(12, 34);
  info.header.frame_id = "crane1_optical";
  info.width = 1920;
  info.height = 1080;
  info.K = {1600, 0, 999.5, 0, 1600, 519.5, 0, 0, 1};
  info.distortion_model = "plumb_bob";
  info.D = {0, 0, 0, 0, 0};
  return info;
}

class Markers : public ::testing::Test {
 protected:
  const Marker& named(const MarkerArray& array, const std::string& name_space) {
    for (const Marker& marker : array.markers) {
      if (marker.ns == name_space) return marker;
    }
    throw std::runtime_error("no marker " + name_space);
  }
  std::map<std::string, int> actions(const MarkerArray& array) {
    std::map<std::string, int> all;
    for (const Marker& marker : array.markers) all[marker.ns] = marker.action;
    return all;
  }
  static std::map<std::string, int> actions_of(int frustum, int axis, int focus, int name) {
    return {{"crane1/frustum", frustum}, {"crane1/axis", axis}, {"crane1/focus", focus}, {"crane1/name", name}};
  }
  const std::map<std::string, int> all_removed =
      actions_of(Marker::DELETE, Marker::DELETE, Marker::DELETE, Marker::DELETE);
  const std::map<std::string, int> without_focus = actions_of(Marker::ADD, Marker::ADD, Marker::DELETE, Marker::ADD);
  const std::map<std::string, int> all_shown = actions_of(Marker::ADD, Marker::ADD, Marker::ADD, Marker::ADD);

  CameraMarkers markers{"crane1", "crane1_optical", 4, 1.5};
};

void expect_point(const geometry_msgs::Point& point, double x, double y, double z) {
  EXPECT_NEAR(point.x, x, 1e-12);
  EXPECT_NEAR(point.y, y, 1e-12);
  EXPECT_NEAR(point.z, z, 1e-12);
}

TEST_F(Markers, AreInTheOpticalFrameAtTheTimeOfTheirSample) {
  const auto& array = markers.draw(some_info(), 2);
  EXPECT_EQ(actions(array), all_shown);
  for (const Marker& marker : array.markers) {
    EXPECT_EQ(marker.header.frame_id, "crane1_optical");
    EXPECT_EQ(marker.header.stamp, ::ros::Time(12, 34));
    EXPECT_EQ(marker.id, 0);
    EXPECT_EQ(marker.lifetime, ::ros::Duration(1.5));
    EXPECT_FALSE(marker.frame_locked);
    EXPECT_EQ(marker.pose.orientation.w, 1);
    EXPECT_GT(marker.color.a, 0);
    EXPECT_GT(marker.scale.x, 0);
  }
  auto later = some_info();
  later.header.stamp = ::ros::Time(13, 0);
  EXPECT_EQ(markers.draw(later, 2).markers.back().header.stamp, ::ros::Time(13, 0));
}

TEST_F(Markers, TheFrustumGoesThroughTheCornersOfTheImage) {
  const Marker& frustum = named(markers.draw(some_info(), 0), "crane1/frustum");
  EXPECT_EQ(int{frustum.type}, int{Marker::LINE_LIST});
  ASSERT_GE(frustum.points.size(), 8u);
  // The last four lines are the edges, from the upper left corner clockwise: 1000 pixels left of the axis, 920 right,
  // 520 above, 560 below.
  const auto* edges = &frustum.points[frustum.points.size() - 8];
  const double left = -1000 / 1600.0, right = 920 / 1600.0, top = -520 / 1600.0, bottom = 560 / 1600.0;
  const double corners[4][2] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  for (int i = 0; i < 4; ++i) {
    expect_point(edges[2 * i], corners[i][0] * marker_near, corners[i][1] * marker_near, marker_near);
    expect_point(edges[2 * i + 1], corners[i][0] * 4, corners[i][1] * 4, 4);
  }
}

TEST_F(Markers, TheAxisEndsWhereTheFrustumDoesAndTheNameIsAbove) {
  const auto& array = markers.draw(some_info(), 0);
  const Marker& axis = named(array, "crane1/axis");
  EXPECT_EQ(int{axis.type}, int{Marker::LINE_LIST});
  ASSERT_EQ(axis.points.size(), 2u);
  expect_point(axis.points[0], 0, 0, 0);
  expect_point(axis.points[1], 0, 0, 4);
  const Marker& name = named(array, "crane1/name");
  EXPECT_EQ(int{name.type}, int{Marker::TEXT_VIEW_FACING});
  EXPECT_EQ(name.text, "crane1");
  EXPECT_LT(name.pose.position.y, 0) << "y is down";
}

TEST_F(Markers, ThePlaneInFocusIsAtItsDistanceIfThereIsOne) {
  const Marker& focus = named(markers.draw(some_info(), 2.5), "crane1/focus");
  EXPECT_EQ(int{focus.type}, int{Marker::TRIANGLE_LIST});
  ASSERT_FALSE(focus.points.empty());
  EXPECT_EQ(focus.points.size() % 3, 0u);
  for (const auto& point : focus.points) EXPECT_DOUBLE_EQ(point.z, 2.5);

  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(), 2 * camera::farthest_focus}) {
    EXPECT_EQ(actions(markers.draw(some_info(), none)), without_focus) << none;
  }
  EXPECT_EQ(actions(markers.draw(some_info(), 2.5)), all_shown);
  for (const auto& point : named(markers.draw(some_info(), 3), "crane1/focus").points) EXPECT_DOUBLE_EQ(point.z, 3);
}

TEST_F(Markers, ZoomingMovesEverythingThatDependsOnIt) {
  markers.draw(some_info(), 2);
  auto zoomed = some_info();
  zoomed.K[0] = zoomed.K[4] = 3200;
  const auto& array = markers.draw(zoomed, 2);
  expect_point(named(array, "crane1/frustum").points.back(), -1000 / 3200.0 * 4, 560 / 3200.0 * 4, 4);
  double farthest_left = 0;
  for (const auto& point : named(array, "crane1/focus").points) farthest_left = std::min(farthest_left, point.x);
  EXPECT_NEAR(farthest_left, -1000 / 3200.0 * 2, 1e-12);
}

TEST_F(Markers, OfALensThatCannotBeDrawnAreRemovedWithTheReason) {
  markers.draw(some_info(), 2);
  EXPECT_TRUE(markers.visible());
  auto folded = some_info();
  folded.D = {-0.9, 0, 0, 0, 0};
  EXPECT_EQ(actions(markers.draw(folded, 2)), all_removed);
  EXPECT_FALSE(markers.visible());
  EXPECT_EQ(markers.statistics().not_drawn, 1u);
  EXPECT_EQ(markers.statistics().reason.camera, camera::CameraReason::not_monotonic);
  markers.draw(folded, 2);
  EXPECT_EQ(markers.statistics().not_drawn, 2u);

  auto fisheye = some_info();
  fisheye.distortion_model = "equidistant";
  EXPECT_EQ(actions(markers.draw(fisheye, 2)), all_removed);
  EXPECT_EQ(markers.statistics().reason.reason, bridge::InfoReason::unknown_model);

  EXPECT_EQ(actions(markers.draw(some_info(), 2)), all_shown);
  EXPECT_TRUE(markers.visible());
  EXPECT_EQ(markers.statistics().not_drawn, 3u);
}

TEST_F(Markers, ThatWereRemovedAreAllAddedAgain) {
  const auto shown = markers.draw(some_info(), 2);
  const auto& removed = markers.remove(::ros::Time(20, 0));
  EXPECT_EQ(actions(removed), all_removed);
  EXPECT_EQ(removed.markers.front().header.stamp, ::ros::Time(20, 0));
  EXPECT_FALSE(markers.visible());
  const auto& again = markers.draw(some_info(), 2);
  EXPECT_EQ(actions(again), all_shown);
  for (std::size_t i = 0; i < shown.markers.size(); ++i) {
    EXPECT_EQ(again.markers[i].points.size(), shown.markers[i].points.size());
  }
}

}  // namespace trk_bridge::ros1::markers_test
