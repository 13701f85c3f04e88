// The log's share of the diagnostics: every event, and of other findings every kind once.
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

  /// Logs events, and findings of a kind that was not met before.
  void write(const std::vector<bridge::Finding>&);

 private:
  std::string subject_;
  std::vector<bridge::Condition> written_;
};

}  // namespace trk_bridge::nodes
