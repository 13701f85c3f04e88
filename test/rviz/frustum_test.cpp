// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Three poses and two lenses, from the tracker's datagram to the pixels on the screen.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../ros/fixture.h"
#include "camera_display.h"
#include "repeating.h"

namespace trk_bridge::test::frustum_test {

struct Pose {
  const char* name;
  wire::Euler euler;
};
struct LensCase {
  const char* name;
  double fov, center_x, center_y, k1, k2;
  double near, far;
  bool strong;  ///< moves the edges by many pixels
};

void PrintTo(const Pose& pose, std::ostream* out) { *out << pose.name; }
void PrintTo(const LensCase& lens, std::ostream* out) { *out << lens.name; }

const Pose poses[] = {{"Level", {0.3, -0.5, 1.2, 20, -8, 5}},
                      {"LookingUp", {-1, 0.5, 0.6, -35, 12, -20}},
                      {"LookingDown", {0.8, 0.2, 2.2, 70, -30, 40}}};
const LensCase lenses[] = {{"Short", 4.8, 0.35, -0.2, 0.006, 0, 0.5, 3, true},
                           {"Long", 40, -0.9, 0.6, -0.002, 1e-5, 3, 9, false}};

/// An image that is wider than the picture on the chip.
wire::CameraConstants with_blanks() {
  wire::CameraConstants c;
  c.image_width = 1920;
  c.image_height = 1080;
  c.blank_left = 200;
  c.blank_right = 20;
  c.blank_top = 10;
  c.blank_bottom = 30;
  c.chip_width = c.fake_chip_width = 9.59;
  c.chip_height = c.fake_chip_height = 5.39;
  return c;
}

/// How many edges of the image are so curved that the middle of the straight line between two corners is far from every
/// line. Expects no colour there, and colour on the curved edge.
int expect_bent(const Picture& picture, const TrackedCamera& camera, double depth, const OrbitView& view,
                const std::vector<Polyline>& lines) {
  const double w = camera.constants.image_width, h = camera.constants.image_height;
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {w, 0}, {w, h}, {0, h}, {0, 0}};
  int bent_edges = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const auto bent = view.shows_at(seen_at(camera, (corners[i] + corners[i + 1]) / 2, depth));
    const auto straight =
        view.shows_at((seen_at(camera, corners[i], depth) + seen_at(camera, corners[i + 1], depth)) / 2);
    const bool apart = std::all_of(lines.begin(), lines.end(),
                                   [&](const auto& line) { return distance(straight, line) > 3 * line_tolerance; });
    if (!apart) continue;
    ++bent_edges;
    EXPECT_TRUE(picture.has(magenta, bent, line_tolerance)) << "edge " << i;
    EXPECT_FALSE(picture.has(magenta, straight, line_tolerance)) << "edge " << i << " is straight";
  }
  return bent_edges;
}

class Frustum : public TrkToRosTest, public ::testing::WithParamInterface<std::tuple<Pose, LensCase>> {
 protected:
  void SetUp() override {
    set("source", any_udp_port);
    window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION);
    ASSERT_TRUE(starts());
    tracker.emplace(port());
  }

  void track(const TrackedCamera& camera_now) {
    sending = std::make_unique<Repeating>(50, [this, one = camera_now]() mutable {
      one.params.counter = ++counter;
      tracker->send(one.constants);
      tracker->send(one.params);
    });
  }

  static TrackedCamera camera_of(const Pose& pose, const LensCase& lens) {
    TrackedCamera camera{with_blanks(), {}};
    camera.params.format = wire::euler;
    camera.params.euler = pose.euler;
    camera.params.fov = lens.fov;
    camera.params.center_x = lens.center_x;
    camera.params.center_y = lens.center_y;
    camera.params.k1 = lens.k1;
    camera.params.k2 = lens.k2;
    return camera;
  }

  /// From the side, so that the complete frustum is in the view and no two of its edges coincide.
  static void look_at(const TrackedCamera& camera, double far) {
    const auto middle = seen_at(camera, {960, 540}, far * 0.55);
    const double pan = camera.params.euler.pan * std::acos(-1.0) / 180;
    window().look({middle, far + 10, pan - 0.6, 0.35});
  }

  std::optional<Tracker> tracker;
  std::atomic<std::uint64_t> counter{0};
  std::unique_ptr<Repeating> sending;
};

TEST_P(Frustum, IsAtThePoseOfTheTrackerAndNowhereElse) {
  const auto& [pose, lens] = GetParam();
  const auto tracked = camera_of(pose, lens);
  look_at(tracked, lens.far);
  auto& display = add_frustum("Camera", name_space + "/camera_info", name_space + "/params");
  property(display, {"Frustum", "Near"}).setValue(lens.near);
  property(display, {"Frustum", "Far"}).setValue(lens.far);
  track(tracked);

  const auto view = window().view();
  // clang 14 cannot capture a structured binding.
  const auto lines_of = [&view, near = lens.near, far = lens.far](const TrackedCamera& one) {
    return seen_by(view, frustum(one, near, far));
  };
  const auto lines = lines_of(tracked);
  for (const auto& line : lines) {
    for (const auto& point : line) ASSERT_TRUE(view.contains(point)) << "the view must show it completely";
  }
  const auto shown = becomes(frustum(tracked, lens.near, lens.far));
  const auto picture = window().picture();
  const std::string name = results_directory() + "/frustum_" + pose.name + "_" + lens.name;
  picture.write(name + ".png");
  EXPECT_TRUE(shown) << statuses(display);
  if (!shown) picture.write(name + "_expected.png", lines);

  const int bent = expect_bent(picture, tracked, lens.far, view, lines);
  EXPECT_GE(bent, lens.strong ? 2 : 0) << "edges that distinguish curved from straight";

  const std::vector<std::pair<const char*, std::function<void(TrackedCamera&)>>> sign_errors{
      {"pan", [](TrackedCamera& c) { c.params.euler.pan *= -1; }},
      {"tilt", [](TrackedCamera& c) { c.params.euler.tilt *= -1; }},
      {"roll", [](TrackedCamera& c) { c.params.euler.roll *= -1; }},
      {"shift to the side", [](TrackedCamera& c) { c.params.center_x *= -1; }},
      {"shift upwards", [](TrackedCamera& c) { c.params.center_y *= -1; }},
      {"distortion", [](TrackedCamera& c) { c.params.k1 *= -1; }},
      {"blanks to the side", [](TrackedCamera& c) { std::swap(c.constants.blank_left, c.constants.blank_right); }},
      {"x", [](TrackedCamera& c) { c.params.euler.x *= -1; }},
      {"height", [](TrackedCamera& c) { c.params.euler.z *= -1; }}};
  for (const auto& [what, negate] : sign_errors) {
    auto wrong = tracked;
    negate(wrong);
    EXPECT_FALSE(picture.shows_only(magenta, lines_of(wrong), line_tolerance)) << what << " of the wrong sign";
  }

  display.setEnabled(false);
  EXPECT_TRUE(window().picture().pixels(magenta).empty());
}

INSTANTIATE_TEST_SUITE_P(Of, Frustum, ::testing::Combine(::testing::ValuesIn(poses), ::testing::ValuesIn(lenses)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + std::get<1>(test.param).name;
                         });

}  // namespace trk_bridge::test::frustum_test
