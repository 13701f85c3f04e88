// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// rviz with the package's configuration: the crane's camera and the one that is received back.
#include <string>
#include <utility>
#include <vector>

#include "camera_display.h"
#include "published_camera.h"

namespace trk_bridge::test::package_configuration_test {

TEST(PackageConfiguration, DrawsBothCameras) {
  const auto of_the_crane = plain_camera(-2, 20), returned = plain_camera(1, -10);
  const PublishedCamera crane("crane", of_the_crane), back("returned", returned);
  const std::vector<std::pair<std::string, TrackedCamera>> cameras{{"Crane's camera", of_the_crane},
                                                                   {"Returned camera", returned}};
  for (const auto& [name, tracked] : cameras) {
    SCOPED_TRACE(name);
    auto& display = window().display(name);
    const auto colour = colour_of(display, {"Frustum", "Color"});
    const double far = property(display, {"Frustum", "Far"}).getValue().toDouble();
    ASSERT_TRUE(property(display, {"Frustum"}).getValue().toBool());
    const double w = tracked.constants.image_width, h = tracked.constants.image_height;
    // One corner may be hidden by a plane or a line of text.
    const auto corners_seen = [&, &tracked = tracked] {
      const auto picture = window().picture();
      int seen = 0;
      for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {w, 0}, {w, h}, {0, h}}) {
        const auto at = window().view().shows_at(seen_at(tracked, corner, far));
        if (picture.has(colour, at, line_tolerance)) ++seen;
      }
      return seen;
    };
    EXPECT_TRUE(window().eventually([&] { return corners_seen() >= 3; })) << corners_seen() << statuses(display);
    for (const char* line : {"Camera Info", "Transform", "Lens", "Age"}) {
      EXPECT_TRUE(window().shows_status(display, line, rviz::StatusProperty::Ok)) << line;
    }
  }
  RvizWindow::screen().save(QString::fromStdString(results_directory() + "/configuration.png"));
}

}  // namespace trk_bridge::test::package_configuration_test
