// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The diagnostics of one camera, input or sink since the last report.
#pragma once

#include <string>
#include <utility>

#include "base/clock.h"
#include "bridge/status.h"
#include "finding_log.h"

namespace trk_bridge::nodes {

/// `Report` is one of those that bridge::findings() and bridge::fill() compare. One thread at a time.
template <typename Report>
class StatusReporter {
 public:
  /// Lines of the log begin with `subject`. The first rates are measured from construction.
  explicit StatusReporter(std::string subject) : log_(std::move(subject)) { last_.time = base::steady_now(); }

  /// The first finding of each kind is also logged. `options` are arguments of findings() for this report.
  template <typename... Options>
  bridge::Status status(Report now, const Options&... options) {
    const auto found = findings(now, last_, options...);
    bridge::Status status;
    fill(status, found, now, last_);
    log_.write(found);
    last_ = std::move(now);
    return status;
  }

 private:
  Report last_;
  FindingLog log_;
};

}  // namespace trk_bridge::nodes
