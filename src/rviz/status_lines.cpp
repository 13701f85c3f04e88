// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "status_lines.h"

namespace trk_bridge::rviz_display {

void StatusLines::set(StatusLevel level, const std::string& name, const std::string& text, double now) {
  const auto found = lines_.find(name);
  if (found != lines_.end() && found->second.level == level &&
      (found->second.text == text || now - found->second.shown < period)) {
    return;
  }
  lines_.insert_or_assign(name, Line{level, text, now});
  show_(level, name, text);
}

void StatusLines::remove(const std::string& name) {
  if (lines_.erase(name) > 0) remove_(name);
}

}  // namespace trk_bridge::rviz_display
