// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// How many frames per second rviz draws with many cameras, with everything shown; run it by hand while a ROS master is
// running: with_display rviz_cameras_bench empty.rviz [CAMERAS [RATE]].
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <QApplication>

#include "published_camera.h"
#include "window.h"

namespace trk_bridge::test {
namespace {

using Clock = std::chrono::steady_clock;

double frames_a_second(RvizWindow& window) {
  const auto begin = Clock::now();
  const auto first = window.manager().getFrameCount();
  (void)window.eventually([&] { return Clock::now() - begin > std::chrono::seconds(5); });
  const std::chrono::duration<double> took = Clock::now() - begin;
  return static_cast<double>(window.manager().getFrameCount() - first) / took.count();
}

void measure(RvizWindow& window, int cameras, double rate) {
  std::vector<std::unique_ptr<PublishedCamera>> published;
  for (int i = 0; i < cameras; ++i) {
    const auto tracked = plain_camera(2.0 * (i % 4) - 3, 5.0 * i);
    published.push_back(std::make_unique<PublishedCamera>("bench" + std::to_string(i), tracked, rate));
    auto& display = window.add("trk_bridge/Camera", published.back()->name());
    property(display, {"Camera Info Topic"}).setValue(QString::fromStdString(published.back()->info_topic()));
    property(display, {"Camera Params Topic"}).setValue(QString::fromStdString(published.back()->params_topic()));
  }
  (void)window.eventually([begin = Clock::now()] { return Clock::now() - begin > std::chrono::seconds(2); });
  std::printf("%8d %12.0f %10.1f\n", cameras, cameras * rate, frames_a_second(window));
  std::fflush(stdout);
  window.remove_all();
}

}  // namespace
}  // namespace trk_bridge::test

int main(int argc, char** argv) {
  ::ros::init(argc, argv, "rviz_cameras_bench");
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s CONFIGURATION [CAMERAS [RATE]]\n", argv[0]);
    return 2;
  }
  const std::string configuration = argv[1];
  const int cameras = argc > 2 ? std::atoi(argv[2]) : 16;
  const double rate = argc > 3 ? std::atof(argv[3]) : 120;
  if (cameras < 1 || !(rate > 0)) {
    std::fprintf(stderr, "%s: CAMERAS and RATE must be more than 0\n", argv[0]);
    return 2;
  }
  QApplication application(argc, argv);
  trk_bridge::test::RvizWindow window(application, configuration);
  std::printf("%8s %12s %10s\n", "cameras", "samples/s", "frames/s");
  trk_bridge::test::measure(window, 0, rate);
  trk_bridge::test::measure(window, cameras, rate);
}
