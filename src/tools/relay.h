// `trk relay`: from any endpoint to any others.
#pragma once

#include <optional>

#include "cli/exit_code.h"
#include "fan_out.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

/// Until the source ends, fails or is stopped, or `seconds` (wall time) have passed; then closes the sinks. Causes of
/// trouble are reported once, where the sinks report theirs, and counted; the summary comes at the end. exit_failed
/// when anything was refused, exit_nothing when nothing was received within `seconds`.
cli::ExitCode relay(transport::Source&, FanOut& sinks, std::optional<double> seconds = std::nullopt);

}  // namespace trk_bridge::tools
