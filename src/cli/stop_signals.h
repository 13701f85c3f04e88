// SIGINT and SIGTERM as an orderly end.
#pragma once

#include <csignal>

#include "base/process.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// While it lives, the first SIGINT or SIGTERM stops `source`, where one is given, and is remembered; what more of them
/// do, base::StopSignals says. SIGPIPE is ignored, so that a closed pipe is an error of writing. One at a time.
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
