// `trk monitor`: a live picture of what comes.
#pragma once

#include <iosfwd>
#include <optional>
#include <vector>

#include "alarm.h"
#include "cli/exit_code.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::monitor {

struct Options {
  std::optional<double> seconds;  ///< of wall time, after which it ends
  /// Those that are raised are the first findings. One that begins rings the terminal's bell; one that ever was raised
  /// makes the exit code cli::exit_alarm.
  std::vector<Alarm> alarms;
};

/// On the whole screen of the terminal, drawn ten times a second, until q is pressed, the time has passed, or the
/// source is stopped or fails; of a source that has ended the last state stays. Then the summary on `err`. Needs
/// StopSignals.
cli::ExitCode show_on_screen(transport::Source&, const Options&, std::ostream& err);

/// As lines, once a second, also when the source ends.
cli::ExitCode show_in_lines(transport::Source&, const Options&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::monitor
