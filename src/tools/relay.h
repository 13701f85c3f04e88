// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk relay`: passes records from any endpoint to any others.
#pragma once

#include <optional>

#include "cli/exit_code.h"
#include "fan_out.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

/// Runs until the source ends, fails or is stopped, or for `seconds` (wall time); then closes the sinks. Problems are
/// reported once, where the sinks report theirs, and counted; the summary is printed at the end. exit_failed if
/// anything was refused, exit_nothing if nothing was received within `seconds`.
cli::ExitCode relay(transport::Source&, FanOut& sinks, std::optional<double> seconds = std::nullopt);

}  // namespace trk_bridge::tools
