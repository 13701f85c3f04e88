// `trk dump`: a record a line.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "cli/exit_code.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

struct DumpOptions {
  bool json = false;
  std::optional<std::uint64_t> count;  ///< of records printed
  std::optional<double> seconds;       ///< of wall time
  bool flush_each = true;              ///< so that a pipe is live
};

/// Prints records to `out`; malformed ones, with reason and sender, and at the end the summary to `err`. That the
/// reader of `out` closed the pipe is an ordinary end. exit_nothing when there is a limit and nothing was received.
cli::ExitCode dump(transport::Source&, const DumpOptions&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::tools
