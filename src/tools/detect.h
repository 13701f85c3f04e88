// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk detect`: finds what is sent to this machine, by whom, in which protocol, and how to receive it.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "cli/exit_code.h"

namespace trk_bridge::tools {

struct DetectOptions {
  /// Ports and groups to listen to, "7000" or "239.135.1.3:55555"; none: all usual places of every protocol.
  std::vector<std::string> places;
  double seconds = 5;
  bool json = false;  ///< a JSON object for each camera
};

/// Listens, and writes results to `out` and messages to `err`. exit_failed if nothing was found. Throws
/// CLI::ValidationError for an invalid place.
cli::ExitCode detect(const DetectOptions&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::tools
