// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Arguments: [FILE...]. Runs all tests of a program, or those of these source files.
#include <gmock/gmock.h>

#include "selected_files.h"

int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  if (!trk_bridge::test::select_files({argv + 1, argv + argc})) return 2;
  return RUN_ALL_TESTS();
}
