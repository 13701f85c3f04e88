// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <string>

#include <gmock/gmock.h>
#include <ros/ros.h>
#include <QApplication>

#include "test_limit.h"
#include "window.h"

namespace trk_bridge::test {
namespace {

RvizWindow* the_window = nullptr;

/// Saves what a failed test saw.
class PicturesOfFailures : public ::testing::EmptyTestEventListener {
  void OnTestStart(const ::testing::TestInfo& test) override {
    name_ = std::string(test.test_suite_name()) + "." + test.name();
    std::replace(name_.begin(), name_.end(), '/', '_');
  }
  void OnTestPartResult(const ::testing::TestPartResult& result) override {
    if (!result.failed()) return;
    const std::string path = results_directory() + "/failed_" + name_ + ".png";
    if (RvizWindow::screen().save(QString::fromStdString(path))) std::printf("The screen then: %s\n", path.c_str());
  }

  std::string name_;
};

}  // namespace

RvizWindow& window() { return *the_window; }

std::string results_directory() {
  const std::string output = ::testing::GTEST_FLAG(output);
  const auto begin = output.find(':'), end = output.find_last_of('/');
  return begin == std::string::npos || end == std::string::npos ? "." : output.substr(begin + 1, end - begin - 1);
}

}  // namespace trk_bridge::test

/// The first argument is the configuration that rviz starts with; rostest may add more arguments.
int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  trk_bridge::test::limit_each_test();
  ::ros::init(argc, argv, "rviz_rostest");
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s CONFIGURATION\n", argv[0]);
    return 2;
  }
  const std::string configuration = argv[1];
  QApplication application(argc, argv);
  trk_bridge::test::RvizWindow window(application, configuration);
  trk_bridge::test::the_window = &window;
  ::testing::UnitTest::GetInstance()->listeners().Append(new trk_bridge::test::PicturesOfFailures);
  return RUN_ALL_TESTS();
}
