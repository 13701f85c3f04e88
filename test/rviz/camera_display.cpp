// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_display.h"

namespace trk_bridge::test {

rviz::Display& add_frustum(const std::string& name, const std::string& info_topic, const std::string& params_topic,
                           const QColor& colour) {
  auto& display = window().add("trk_bridge/Camera", name);
  for (const char* part : {"Image Plane", "Focus Plane", "Optical Axis", "Body", "Camera Name", "Values", "Trail"}) {
    property(display, {part}).setValue(false);
  }
  property(display, {"Frustum", "Color"}).setValue(colour);
  property(display, {"Frustum", "Line Width"}).setValue(0.03);
  property(display, {"Frustum", "Near"}).setValue(near_depth);
  property(display, {"Frustum", "Far"}).setValue(far_depth);
  property(display, {"Camera Info Topic"}).setValue(QString::fromStdString(info_topic));
  property(display, {"Camera Params Topic"}).setValue(QString::fromStdString(params_topic));
  return display;
}

::testing::AssertionResult becomes(const std::vector<Path>& paths, const QColor& colour) {
  ::testing::AssertionResult shown = ::testing::AssertionFailure();
  (void)window().eventually([&] {
    shown = window().picture().shows_only(colour, seen_by(window().view(), paths), line_tolerance);
    return bool(shown);
  });
  return shown;
}

::testing::AssertionResult becomes(const TrackedCamera& camera, const QColor& colour) {
  return becomes(frustum(camera, near_depth, far_depth), colour);
}

::testing::AssertionResult vanishes(const QColor& colour) {
  std::size_t left = 0;
  if (window().eventually([&] { return (left = window().picture().pixels(colour).size()) == 0; })) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << left << " pixels are still there";
}

}  // namespace trk_bridge::test
