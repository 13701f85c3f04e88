// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Ends a program in order on SIGINT and SIGTERM.
#pragma once

#include <csignal>

#include "base/process.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// While it exists, the first SIGINT or SIGTERM stops `source`, if one is given, and is remembered; for further signals
/// see base::StopSignals. SIGPIPE is ignored, so that a closed pipe is a write error. Only one object at a time.
class StopSignals {
 public:
  explicit StopSignals(transport::Source* source = nullptr);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool stopped() noexcept { return base::StopSignals::received(); }

 private:
  base::StopSignals signals_;
  struct sigaction pipe_ {};
};

}  // namespace trk_bridge::cli
