// `trk monitor`: a live picture of what comes.
#pragma once

#include <iosfwd>
#include <optional>

#include "cli/exit_code.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::monitor {

/// On the whole screen of the terminal, drawn ten times a second, until q is pressed, `seconds` of wall time
/// have passed, or the source is stopped or fails; of a source that has ended the last state stays. Then the summary on
/// `err`. Needs StopSignals.
cli::ExitCode show_on_screen(transport::Source&, std::optional<double> seconds, std::ostream& err);

/// As lines, once a second, also when the source ends.
cli::ExitCode show_in_lines(transport::Source&, std::optional<double> seconds, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::monitor
