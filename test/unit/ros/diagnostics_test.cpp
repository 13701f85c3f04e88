// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/diagnostics.h"

#include <gmock/gmock.h>

namespace trk_bridge::ros1::diagnostics_test {

using bridge::Level;
using diagnostic_msgs::DiagnosticStatus;

TEST(Diagnostics, LevelsAreThoseOfTheMessage) {
  for (const auto& [level, number] :
       {std::pair(Level::ok, DiagnosticStatus::OK), std::pair(Level::warn, DiagnosticStatus::WARN),
        std::pair(Level::error, DiagnosticStatus::ERROR), std::pair(Level::stale, DiagnosticStatus::STALE)}) {
    bridge::Status status;
    status.level = level;
    diagnostic_updater::DiagnosticStatusWrapper message;
    to_msg(status, message);
    EXPECT_EQ(int{message.level}, int{number});
  }
}

TEST(Diagnostics, TextsAndValuesInOrder) {
  bridge::Status status;
  status.message = "receiving";
  status.hardware_id = "udp port 7000";
  status.add("lost", std::uint64_t{4});
  status.add("format", "euler");
  diagnostic_updater::DiagnosticStatusWrapper message;
  message.name = "trk_to_ros: crane1";
  to_msg(status, message);
  EXPECT_EQ(message.name, "trk_to_ros: crane1");
  EXPECT_EQ(message.message, "receiving");
  EXPECT_EQ(message.hardware_id, "udp port 7000");
  ASSERT_EQ(message.values.size(), 2u);
  EXPECT_EQ(message.values[0].key, "lost");
  EXPECT_EQ(message.values[0].value, "4");
  EXPECT_EQ(message.values[1].key, "format");
  EXPECT_EQ(message.values[1].value, "euler");
}

}  // namespace trk_bridge::ros1::diagnostics_test
