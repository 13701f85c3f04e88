// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Logs findings of the diagnostics: every event, and each other kind once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bridge/finding.h"

namespace trk_bridge::nodes {

/// One thread at a time.
class FindingLog {
 public:
  /// Lines begin with `subject`.
  explicit FindingLog(std::string subject) : subject_(std::move(subject)) {}

  /// Logs events, and the first finding of each kind.
  void write(const std::vector<bridge::Finding>&);

 private:
  std::string subject_;
  std::vector<bridge::Condition> written_;
};

}  // namespace trk_bridge::nodes
