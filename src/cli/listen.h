// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The loop in which a program receives records from a source.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "exit_code.h"
#include "tally.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// Handles what a source receives.
class Listener {
 public:
  virtual ~Listener() = default;
  /// Returns whether to continue.
  virtual bool on_sample(const transport::Sample&) = 0;
  /// Called for a malformed record.
  virtual void on_malformed(const transport::Reception&) = 0;
};

enum class Ending : std::uint8_t {
  enough,   ///< the listener returned false, or the time limit has passed
  stopped,  ///< by Source::stop
  ended,    ///< the source has no more records
  failed,   ///< the source failed
};

/// Runs until the source ends, is stopped or fails, until the listener returns false, or for `seconds` (wall time).
Ending listen(transport::Source&, Listener&, std::optional<double> seconds = std::nullopt);

/// Prints the summary on `err`, then what the source was waiting for, or its error if it failed. Returns the exit
/// code: exit_nothing if there was a limit (of records or time) and no record was received.
ExitCode report_end(const Tally&, const transport::SourceStatistics&, Ending, bool has_limit, std::ostream& err);

}  // namespace trk_bridge::cli
