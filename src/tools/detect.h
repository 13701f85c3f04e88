// `trk detect`: who sends what to this machine, in which protocol, and how to read it.
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

/// Listens, and writes what was found to `out`, and how it goes to `err`. exit_failed where there is nothing. Throws
/// CLI::ValidationError for a place that is none.
cli::ExitCode detect(const DetectOptions&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::tools
