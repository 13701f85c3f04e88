// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Cameras drawn as markers.
#include <cmath>
#include <map>
#include <set>

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>
#include <visualization_msgs/MarkerArray.h>

#include "fixture.h"

namespace trk_bridge::test::markers_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// A lens with distortion and an axis off the centre.
wire::CameraParams bent(std::uint64_t counter, std::uint32_t id = 0) {
  auto params = test::params(counter, id);
  params.fov = 8;
  params.center_x = 0.3;
  params.center_y = -0.2;
  params.k1 = -4e-4;
  params.k2 = -5e-6;
  return params;
}

class MarkersOff : public TrkToRosTest {};

TEST_F(MarkersOff, ByDefaultThereIsNoTopic) {
  set("source", any_udp_port);
  ASSERT_TRUE(starts());
  EXPECT_TRUE(is_advertised(name_space + "/params"));
  EXPECT_FALSE(is_advertised(node_name + "/markers"));
}

class MarkersRefused : public TrkToRosTest {};

TEST_F(MarkersRefused, WrongValuesAndKeysAreNamedWithWhatIsAllowed) {
  set("source", any_udp_port);
  set("publish_markers", "yes");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~publish_markers = 'yes'"), HasSubstr("must be true or false")));
  set("publish_markers", true);
  set("marker_far", 0.1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~marker_far = 0.1"), HasSubstr("at most 1000 metres")));
  set("marker_far", 3);
  set("publish_camera_info", false);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~publish_markers = true"), HasSubstr("needs publish_camera_info")));
  set("publish_camera_info", true);
  set("publish_marker", true);
  EXPECT_THAT(refusal(), HasSubstr("~publish_marker = 1: unknown parameter, nearest is publish_markers"));
}

class Markers : public TrkToRosTest {
 protected:
  void SetUp() override {
    set("source", any_udp_port);
    set("publish_markers", true);
    set("marker_far", 6);
    const std::string left = camera + "_left", right = camera + "_right";
    set("cameras/" + left + "/id", 1);
    set("cameras/" + right + "/id", 2);
    cameras = {left, right};
    markers.emplace(node_name + "/markers");
    for (const auto& name : cameras) infos[name].emplace(name_space + "/" + name + "/camera_info");
    ASSERT_TRUE(starts(right));
    tracker.emplace(port(right));
    tracker->send(test::constants());
  }

  /// The newest of every namespace.
  std::map<std::string, Marker> newest() const {
    std::map<std::string, Marker> all;
    for (const auto& array : markers->messages) {
      for (const auto& marker : array.markers) all[marker.ns] = marker;
    }
    return all;
  }
  int action(const std::string& name_space_of_marker) const {
    const auto all = newest();
    const auto found = all.find(name_space_of_marker);
    return found == all.end() ? -1 : found->second.action;
  }

  std::vector<std::string> cameras;
  std::optional<Recorder<MarkerArray>> markers;
  std::map<std::string, std::optional<Recorder<sensor_msgs::CameraInfo>>> infos;
  std::optional<Tracker> tracker;
};

TEST_F(Markers, AllFourOfBothCamerasAreOnOneTopicAndMatchTheCornersOfTheirImages) {
  tracker->send(bent(1, 1));
  auto other = bent(1, 2);
  other.fov = 12;
  tracker->send(other);
  ASSERT_TRUE(eventually([this] { return markers->messages.size() == 2; }));
  std::set<std::string> wanted;
  for (const auto& name : cameras) {
    for (const char* part : {"/frustum", "/axis", "/focus", "/name"}) wanted.insert(name + part);
  }
  std::set<std::string> seen;
  for (const auto& [name, marker] : newest()) {
    EXPECT_EQ(int{marker.action}, int{Marker::ADD}) << name;
    seen.insert(name);
  }
  EXPECT_EQ(seen, wanted);

  for (const auto& name : cameras) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(eventually([&] { return infos[name]->messages.size() == 1; }));
    const auto& info = infos[name]->messages.back();
    const Marker frustum = newest().at(name + "/frustum");
    EXPECT_EQ(frustum.header.stamp, info.header.stamp);
    EXPECT_EQ(frustum.header.frame_id, name + "_optical");
    image_geometry::PinholeCameraModel model;
    model.fromCameraInfo(info);
    // The last four lines are the edges, from the upper left corner of the image clockwise.
    const auto* edges = &frustum.points.at(frustum.points.size() - 8);
    const double corners[4][2] = {{-0.5, -0.5}, {719.5, -0.5}, {719.5, 575.5}, {-0.5, 575.5}};
    for (int i = 0; i < 4; ++i) {
      for (const auto& point : {edges[2 * i], edges[2 * i + 1]}) {
        const auto pixel = model.unrectifyPoint(model.project3dToPixel({point.x, point.y, point.z}));
        EXPECT_LT(std::hypot(pixel.x - corners[i][0], pixel.y - corners[i][1]), 1e-3) << pixel;
      }
      EXPECT_DOUBLE_EQ(edges[2 * i + 1].z, 6);
    }
    const Marker focus = newest().at(name + "/focus");
    EXPECT_FALSE(focus.points.empty());
    for (const auto& point : focus.points) EXPECT_DOUBLE_EQ(point.z, 4.5);
    EXPECT_EQ(newest().at(name + "/name").text, name);
  }
}

TEST_F(Markers, AreRemovedWithWhatTheyShow) {
  const std::string& name = cameras[0];
  tracker->send(bent(1, 1));
  ASSERT_TRUE(eventually([&] { return action(name + "/focus") == Marker::ADD; }));
  auto unfocused = bent(2, 1);
  unfocused.focdist = 0;
  tracker->send(unfocused);
  ASSERT_TRUE(eventually([&] { return action(name + "/focus") == Marker::DELETE; }));
  EXPECT_EQ(action(name + "/frustum"), Marker::ADD);

  auto folded = bent(3, 1);
  folded.k1 = -1;
  tracker->send(folded);
  ASSERT_TRUE(eventually([&] { return action(name + "/frustum") == Marker::DELETE; }));
  EXPECT_EQ(action(name + "/name"), Marker::DELETE);
  tracker->send(bent(4, 1));
  EXPECT_TRUE(eventually([&] { return action(name + "/frustum") == Marker::ADD; }));
}

TEST_F(Markers, OfALensThatIsTooWideAreNotDrawnAndTheReasonIsReported) {
  const std::string& name = cameras[0];
  tracker->send(bent(1, 1));
  ASSERT_TRUE(eventually([&] { return action(name + "/frustum") == Marker::ADD; }));
  auto wide = test::params(2, 1);
  wide.fov = 0.05;  // mm, of a chip of 8.8 mm
  tracker->send(wide);
  EXPECT_TRUE(eventually([&] { return action(name + "/frustum") == Marker::DELETE; }));
  EXPECT_TRUE(diagnostics.reports(status_name(name), diagnostic_msgs::DiagnosticStatus::WARN,
                                  "no markers: the image extends more than 89 degrees from the optical axis"));
  EXPECT_EQ(infos[name]->messages.size(), 2u) << "the lens is valid nevertheless";
}

}  // namespace trk_bridge::test::markers_test
