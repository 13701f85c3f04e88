// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Checks the test support of this directory with rviz's displays, whose drawing is known.
#include <ros/ros.h>
#include <visualization_msgs/Marker.h>

#include "window.h"

namespace trk_bridge::test::harness_test {

const QColor magenta(255, 0, 255);

class Harness : public ::testing::Test {
 protected:
  void SetUp() override { window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION); }
};

TEST_F(Harness, OurProjectionIsThatOfTheRenderer) {
  const std::vector<OrbitView::Place> places{
      {{0, 0, 0}, 10, -1.2, 0.4}, {{1, -2, 3}, 4, 2.5, -0.9}, {{0, 0, 0}, 7, 0, 0}};
  for (const auto& place : places) {
    window().look(place);
    ASSERT_TRUE(window().draws());
    for (const Eigen::Vector3d& aside :
         {Eigen::Vector3d(0, 0, 0), {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {-1, 0.7, 0.2}}) {
      const Eigen::Vector3d point = place.focal_point + aside;
      EXPECT_LT((window().view().shows_at(point) - window().rendered_at(point)).norm(), 0.05) << point.transpose();
    }
  }
}

TEST_F(Harness, LinesOfRvizAreFoundWhereTheyAreAndNowhereElse) {
  ::ros::NodeHandle ros;
  auto publisher = ros.advertise<visualization_msgs::Marker>("/harness/marker", 1, /*latch=*/true);
  visualization_msgs::Marker marker;
  marker.header.frame_id = "studio";
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.pose.orientation.w = 1;
  marker.scale.x = 0.03;
  marker.color.r = marker.color.b = marker.color.a = 1;
  const std::vector<Eigen::Vector3d> points{{-1, -2, 0.5}, {2, 1, 1.5}, {0, 0, 0}, {0, 0, 2}};
  for (const auto& p : points) {
    marker.points.emplace_back();
    marker.points.back().x = p.x();
    marker.points.back().y = p.y();
    marker.points.back().z = p.z();
  }
  auto& display = window().add("rviz/Marker", "Lines");
  property(display, {"Marker Topic"}).setValue("/harness/marker");
  publisher.publish(marker);

  const auto view = window().view();
  const auto line = [&](std::size_t i) { return Polyline{view.shows_at(points[i]), view.shows_at(points[i + 1])}; };
  ::testing::AssertionResult shown = ::testing::AssertionFailure();
  EXPECT_TRUE(window().eventually([&] {
    return bool(shown = window().picture().shows_only(magenta, {line(0), line(2)}, 3));
  })) << shown.message();
  const auto picture = window().picture();
  picture.write(results_directory() + "/harness_lines.png");
  EXPECT_FALSE(picture.shows_only(magenta, {line(0)}, 3)) << "an additional line";
  EXPECT_FALSE(picture.shows_only(magenta, {line(0), line(2), {{20, 20}, {40, 40}}}, 3)) << "a missing line";
  Polyline beside = line(0);
  for (auto& point : beside) point.y() += 6;
  EXPECT_FALSE(picture.shows_only(magenta, {beside, line(2)}, 3)) << "a line beside the expected one";

  display.setEnabled(false);
  EXPECT_TRUE(window().picture().pixels(magenta).empty());
}

}  // namespace trk_bridge::test::harness_test
