// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A test program contains the tests of several source files; ctest runs one process for each file.
#pragma once

#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::test {

/// Only tests of these source files (names without folders) will run, and of these not those that the filter of
/// GoogleTest excludes; all tests if no file is given. Call it after InitGoogleTest(). Returns false, with a message on
/// standard error, for a file without tests, and if the filter of GoogleTest selects tests, too.
inline bool select_files(const std::vector<std::string>& files) {
  if (files.empty()) return true;
  const std::string given = ::testing::GTEST_FLAG(filter);
  const auto minus = given.find('-');
  if (const auto selected = given.substr(0, minus); selected != "*" && !selected.empty()) {
    std::fprintf(stderr, "the filter '%s' selects tests, and so does '%s'; give only one of them\n", given.c_str(),
                 files.front().c_str());
    return false;
  }

  const std::set<std::string> wanted(files.begin(), files.end());
  std::set<std::string> all;
  std::string filter;
  const auto& tests = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < tests.total_test_suite_count(); ++s) {
    const auto& suite = *tests.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const auto& test = *suite.GetTestInfo(t);
      const std::string path = test.file();
      const auto& file = *all.insert(path.substr(path.find_last_of('/') + 1)).first;
      if (wanted.count(file) > 0) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  for (const auto& file : wanted) {
    if (all.count(file) > 0) continue;
    std::fprintf(stderr, "no test is in the file '%s'; the files are:\n", file.c_str());
    for (const auto& known : all) std::fprintf(stderr, "  %s\n", known.c_str());
    return false;
  }
  ::testing::GTEST_FLAG(filter) = filter + (minus == std::string::npos ? "" : given.substr(minus));
  return true;
}

}  // namespace trk_bridge::test
