// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <string>

#include <gmock/gmock.h>
#include <ros/ros.h>
#include <QApplication>

#include "selected_files.h"
#include "test_limit.h"
#include "window.h"

namespace trk_bridge::test {
namespace {

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

std::string results_directory() {
  const std::string output = ::testing::GTEST_FLAG(output);
  const auto begin = output.find(':'), end = output.find_last_of('/');
  return begin == std::string::npos || end == std::string::npos ? "." : output.substr(begin + 1, end - begin - 1);
}

}  // namespace trk_bridge::test

/// Arguments: CONFIGURATION [FILE...]. Runs the tests of these source files in an rviz that starts with this
/// configuration.
int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  trk_bridge::test::limit_each_test();
  ::ros::init(argc, argv, "rviz_window_tests");
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s CONFIGURATION [FILE...]\n", argv[0]);
    return 2;
  }
  if (!trk_bridge::test::select_files({argv + 2, argv + argc})) return 2;
  const std::string configuration = argv[1];
  QApplication application(argc, argv);
  trk_bridge::test::RvizWindow window(application, configuration);
  ::testing::UnitTest::GetInstance()->listeners().Append(new trk_bridge::test::PicturesOfFailures);
  return RUN_ALL_TESTS();
}
