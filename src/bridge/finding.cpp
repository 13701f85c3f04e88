// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "finding.h"

#include <algorithm>
#include <utility>

namespace trk_bridge::bridge {

void warn(std::vector<Finding>& found, Condition condition, std::string text) {
  found.push_back({condition, Level::warn, std::move(text)});
}

void summarize(const std::vector<Finding>& found, Status& status) {
  Level level = Level::ok;
  std::string text;
  for (const auto& finding : found) {
    level = std::max(level, finding.level);
    text += (text.empty() ? "" : "; ") + finding.text;
  }
  status.level = level;
  status.message = text;
}

}  // namespace trk_bridge::bridge
