// How a program of this project ends.
#pragma once

namespace trk_bridge::cli {

enum ExitCode : int {
  exit_good = 0,
  exit_failed = 1,  ///< something could not be opened, received or sent
  exit_usage = 2,   ///< the command line was not understood
  exit_alarm = 3,   ///< an alarm was raised
};

}  // namespace trk_bridge::cli
