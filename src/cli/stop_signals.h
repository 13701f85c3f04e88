// SIGINT and SIGTERM as an orderly end.
#pragma once

#include <csignal>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// While it lives, SIGINT or SIGTERM stops `source`, where one is given, and is remembered; a second one of the same
/// kind ends the process at once. SIGPIPE is ignored, so that a closed pipe is an error of writing. One at a time.
class StopSignals {
 public:
  explicit StopSignals(transport::Source* source = nullptr);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool stopped() noexcept;

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
  struct sigaction pipe_ {};
};

}  // namespace trk_bridge::cli
