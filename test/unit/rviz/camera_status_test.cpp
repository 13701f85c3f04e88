// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The status texts of a display in each of its conditions.
#include "rviz/camera_status.h"

#include <cmath>
#include <map>

#include <gmock/gmock.h>

namespace trk_bridge::rviz_display::camera_status_test {

using testing::AllOf;
using testing::HasSubstr;

class CameraStatusTest : public testing::Test {
 protected:
  void SetUp() override { at(1000); }
  // Long enough after the previous call, so that no text is held back.
  void at(double time) { status.begin(ros::Time(time), steady += 10); }
  std::string line(const std::string& name) const {
    const auto found = lines.find(name);
    return found == lines.end() ? "" : found->second;
  }

  std::map<std::string, std::string> lines;
  CameraStatus status{[this](StatusLevel level, const std::string& name, const std::string& text) {
                        const char* const names[] = {"Ok: ", "Warn: ", "Error: "};
                        lines[name] = names[static_cast<int>(level)] + text;
                      },
                      [this](const std::string& name) { lines.erase(name); }};
  double steady = 0;
  const TopicState none{};
  const TopicState silent{"/a/camera_info", "", 0, {}, false};
  const TopicState gone{"/a/camera_info", "", 7, ros::Time(990), false};
  const TopicState good{"/a/camera_info", "", 7, ros::Time(999.9), true};
  const TopicState params{"/a/params", "", 9, ros::Time(999.9), true};
};

TEST_F(CameraStatusTest, TopicsShowWhetherMessagesArrive) {
  status.camera_info(none);
  EXPECT_EQ(line("Camera Info"), "Warn: no topic selected");
  status.camera_info({"a b", "Character is not valid", 0, {}, false});
  EXPECT_EQ(line("Camera Info"), "Error: Character is not valid");
  at(1001);
  status.camera_info(silent);
  EXPECT_EQ(line("Camera Info"), "Warn: no messages received on /a/camera_info");
  status.camera_info(good);
  EXPECT_EQ(line("Camera Info"), "Ok: 7 messages received");
  at(1002);
  status.camera_info(gone);
  EXPECT_THAT(line("Camera Info"), AllOf(HasSubstr("Warn: "), HasSubstr("12.0 s"), HasSubstr("since 990")));
}

TEST_F(CameraStatusTest, ParamsAreOptional) {
  status.camera_params(none, "");
  EXPECT_EQ(line("Camera Params"), "");
  status.camera_params(params, "");
  EXPECT_EQ(line("Camera Params"), "Ok: 9 messages received");
  status.camera_params(params, "not a rotation");
  EXPECT_THAT(line("Camera Params"), AllOf(HasSubstr("Warn: "), HasSubstr("not a rotation")));
  status.camera_params(none, "");
  EXPECT_EQ(line("Camera Params"), "");
}

TEST_F(CameraStatusTest, ConstantsAreUnknownIfOnlyParamsArrive) {
  status.constants(silent, params);
  EXPECT_THAT(line("Constants"), HasSubstr("Warn: unknown"));
  status.constants(good, params);
  EXPECT_EQ(line("Constants"), "Ok: known");
  status.constants(gone, params);
  EXPECT_EQ(line("Constants"), "Ok: known");
  status.constants(good, none);
  EXPECT_EQ(line("Constants"), "");
  status.constants(none, params);
  EXPECT_EQ(line("Constants"), "") << "there may be CameraInfo that is not subscribed to";
}

TEST_F(CameraStatusTest, TransformShowsTheReasonOfTf) {
  status.transform("Frame [x] does not exist");
  EXPECT_EQ(line("Transform"), "Error: Frame [x] does not exist");
  status.transform("");
  EXPECT_THAT(line("Transform"), HasSubstr("Ok: "));
}

TEST_F(CameraStatusTest, LensIsDescribedOrItsFaultShown) {
  sensor_msgs::CameraInfo info;
  info.width = info.height = 100;
  LensView lens;
  lens.update(info);
  status.lens(lens);
  EXPECT_THAT(line("Lens"), AllOf(HasSubstr("Error: "), HasSubstr("fx 0")));
  info.K = {100, 0, 50, 0, 100, 50, 0, 0, 1};
  lens.update(info);
  status.lens(lens);
  EXPECT_THAT(line("Lens"), HasSubstr("Ok: fx 100"));
}

TEST_F(CameraStatusTest, FrustumMustHaveItsDepthsInOrder) {
  status.frustum(true, 3, 2);
  EXPECT_THAT(line("Frustum"), AllOf(HasSubstr("Error: "), HasSubstr("3 m"), HasSubstr("2 m")));
  status.frustum(false, 3, 2);
  EXPECT_EQ(line("Frustum"), "");
  status.frustum(true, 2, 2);
  EXPECT_THAT(line("Frustum"), HasSubstr("Error: "));
  status.frustum(true, 2, 3);
  EXPECT_EQ(line("Frustum"), "");
}

TEST_F(CameraStatusTest, FocusPlaneShowsWhyItIsNotDrawn) {
  status.focus_plane(3.5);
  EXPECT_EQ(line("Focus Plane"), "Ok: 3.5 m");
  for (const double beyond : {0.0, -1.0, 1e9, std::nan("")}) {
    at(1001);
    status.focus_plane(beyond);
    EXPECT_THAT(line("Focus Plane"), HasSubstr("not drawn")) << beyond;
  }
  status.no_focus_plane();
  EXPECT_EQ(line("Focus Plane"), "");
}

TEST_F(CameraStatusTest, PartsThatAreNotDrawnHaveNoLine) {
  status.transform("gone");
  status.frustum(true, 3, 2);
  status.focus_plane(3);
  status.age(ros::Time(999), ros::Time(999));
  status.camera_info(good);
  EXPECT_EQ(lines.size(), 5u);
  status.nothing_drawn(true);
  EXPECT_EQ(lines.size(), 3u);
  EXPECT_NE(line("Transform"), "");
  EXPECT_NE(line("Age"), "");
  status.nothing_drawn(false);
  EXPECT_EQ(line("Transform"), "");
  EXPECT_NE(line("Camera Info"), "");
}

TEST_F(CameraStatusTest, AgeWarnsWhenTheCameraIsNotLive) {
  status.age(ros::Time(999.98), ros::Time(999.99));
  EXPECT_EQ(line("Age"), "Ok: 0.02 s");
  status.age(ros::Time(998), ros::Time(998));
  EXPECT_THAT(line("Age"), HasSubstr("Warn: 2.00 s"));
}

}  // namespace trk_bridge::rviz_display::camera_status_test
