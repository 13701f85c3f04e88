// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk monitor`: shows live what is received.
#pragma once

#include <iosfwd>
#include <optional>
#include <vector>

#include "alarm.h"
#include "cli/exit_code.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::monitor {

struct Options {
  std::optional<double> seconds;  ///< wall time after which it ends
  /// Raised alarms are the first findings. A new alarm rings the bell of the terminal; if any alarm was raised, the
  /// exit code is cli::exit_alarm.
  std::vector<Alarm> alarms;
};

/// Uses the whole screen of the terminal, drawn ten times a second, until q is pressed, the time has passed, or the
/// source is stopped or fails; after the source has ended, the last state stays visible. Then prints the summary on
/// `err`. Needs StopSignals.
cli::ExitCode show_on_screen(transport::Source&, const Options&, std::ostream& err);

/// Prints lines once a second, and when the source ends.
cli::ExitCode show_in_lines(transport::Source&, const Options&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::monitor
