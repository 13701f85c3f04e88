// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk dump`: prints one record per line.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "cli/exit_code.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

struct DumpOptions {
  bool json = false;
  std::optional<std::uint64_t> count;  ///< number of records to print
  std::optional<double> seconds;       ///< wall time
  bool flush_each = true;              ///< so that readers of a pipe get records at once
};

/// Prints records to `out`; malformed ones, with reason and sender, and at the end the summary to `err`. A pipe that
/// the reader of `out` closed is not an error.
/// exit_nothing if there is a limit and nothing was received.
cli::ExitCode dump(transport::Source&, const DumpOptions&, std::ostream& out, std::ostream& err);

}  // namespace trk_bridge::tools
