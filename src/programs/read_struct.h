// What the programs read_mem, read_net and read_file share.
#pragma once

#include <trk/trk_struct.h>

#include <functional>
#include <iosfwd>

#include "cli/exit_code.h"

namespace trk_bridge::programs {

/// One line each, numbers with the fewest digits that read back to the same value.
void print(std::ostream&, const trkCameraConstants&);
void print(std::ostream&, const trkCameraParams&);

/// The reading functions of one open handle.
struct Reader {
  std::function<trkError(trkCameraConstants*)> constants;
  std::function<trkError(trkCameraParams*)> params;
};

/// Looks once a second for thirty seconds, or until a signal, and prints what is new. A datagram or set that is not
/// sound is told on standard error.
cli::ExitCode poll_and_print(const Reader&);

}  // namespace trk_bridge::programs
