// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "finding_log.h"

#include <algorithm>

#include <ros/console.h>

namespace trk_bridge::nodes {

using bridge::Level;

void FindingLog::write(const std::vector<bridge::Finding>& found) {
  for (const auto& finding : found) {
    if (!finding.is_event) {
      if (std::find(written_.begin(), written_.end(), finding.condition) != written_.end()) continue;
      written_.push_back(finding.condition);
    }
    const std::string line = subject_ + ": " + finding.text;
    switch (finding.level) {
      case Level::error:
        ROS_ERROR_STREAM(line);
        break;
      case Level::warn:
        ROS_WARN_STREAM(line << (finding.is_event ? "" : " (logged once, then counted in the diagnostics)"));
        break;
      default:
        ROS_INFO_STREAM(line);
        break;
    }
  }
}

}  // namespace trk_bridge::nodes
