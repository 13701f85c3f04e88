// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Exit codes of the programs.
#pragma once

namespace trk_bridge::cli {

enum ExitCode : int {
  exit_good = 0,
  exit_failed = 1,   ///< something could not be opened, received or sent
  exit_usage = 2,    ///< the command line was not understood
  exit_nothing = 3,  ///< a limit was given, and no record was received
  exit_alarm = 4,    ///< an alarm was raised
};

}  // namespace trk_bridge::cli
