// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A status is shown at once when its level changes, and less often when only its text changes.
#include "rviz/status_lines.h"

#include <vector>

#include <gmock/gmock.h>

namespace trk_bridge::rviz_display::status_lines_test {

using testing::ElementsAre;

class StatusLinesTest : public testing::Test {
 protected:
  std::vector<std::string> shown;
  StatusLines lines{[this](StatusLevel level, const std::string& name, const std::string& text) {
                      shown.push_back(name + std::to_string(static_cast<int>(level)) + " " + text);
                    },
                    [this](const std::string& name) { shown.push_back("no " + name); }};
};

TEST_F(StatusLinesTest, TheSameTextIsShownOnce) {
  for (int i = 0; i < 100; ++i) lines.set(StatusLevel::ok, "Lens", "good", i);
  EXPECT_THAT(shown, ElementsAre("Lens0 good"));
}

TEST_F(StatusLinesTest, TextsDoNotFlicker) {
  for (int i = 0; i <= 30; ++i) lines.set(StatusLevel::ok, "Age", std::to_string(i), i / 30.0);
  EXPECT_GE(shown.size(), 3u);
  EXPECT_LE(shown.size(), 5u);
}

TEST_F(StatusLinesTest, TheLastTextIsShownInTheEnd) {
  lines.set(StatusLevel::ok, "Age", "1", 0);
  for (int i = 1; i <= 30; ++i) lines.set(StatusLevel::ok, "Age", "2", i / 30.0);
  EXPECT_THAT(shown, ElementsAre("Age0 1", "Age0 2"));
}

TEST_F(StatusLinesTest, LevelsAreShownAtOnce) {
  lines.set(StatusLevel::ok, "Lens", "good", 0);
  lines.set(StatusLevel::error, "Lens", "bad", 0.01);
  EXPECT_THAT(shown, ElementsAre("Lens0 good", "Lens2 bad"));
}

TEST_F(StatusLinesTest, RemovedOnesAreShownAgain) {
  lines.remove("Lens");
  EXPECT_TRUE(shown.empty());
  lines.set(StatusLevel::ok, "Lens", "good", 0);
  lines.remove("Lens");
  lines.remove("Lens");
  lines.set(StatusLevel::ok, "Lens", "good", 0);
  lines.forget();
  lines.set(StatusLevel::ok, "Lens", "good", 0);
  EXPECT_THAT(shown, ElementsAre("Lens0 good", "no Lens", "Lens0 good", "Lens0 good"));
}

}  // namespace trk_bridge::rviz_display::status_lines_test
