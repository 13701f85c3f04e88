// The loop in which a program receives records from a source.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "exit_code.h"
#include "tally.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// What a program does with what comes.
class Listener {
 public:
  virtual ~Listener() = default;
  /// Whether to go on.
  virtual bool on_sample(const transport::Sample&) = 0;
  /// One record was malformed.
  virtual void on_malformed(const transport::Reception&) = 0;
};

enum class Ending : std::uint8_t {
  enough,   ///< the listener wants no more, or the time limit has passed
  stopped,  ///< by Source::stop
  ended,    ///< the source has no more
  failed,   ///< the source cannot go on
};

/// Until the source ends, is stopped or fails, the listener has enough, or `seconds` (wall time) have passed.
Ending listen(transport::Source&, Listener&, std::optional<double> seconds = std::nullopt);

/// The end of a program that has listened: the summary on `err`, and then what the source waited for, or its error
/// where it failed. With a limit (of records or time), exit_nothing if no record was received.
ExitCode report_end(const Tally&, const transport::SourceStatistics&, Ending, bool has_limit, std::ostream& err);

}  // namespace trk_bridge::cli
