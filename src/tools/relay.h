// `trk relay`: from any endpoint to any others.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <vector>

#include "cli/exit_code.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

struct RelayOptions {
  /// The format to pass parameters on in, which has passed wire::check_writable; none: as they come, double for double.
  std::optional<std::uint32_t> format;
  std::optional<std::uint32_t> id;  ///< in place of the id that came
};

/// Until the source ends, fails or is stopped; then closes the sinks. Causes of trouble are told once on `err` and
/// counted, the summary comes at the end. exit_failed when anything was refused.
cli::ExitCode relay(transport::Source&, std::vector<std::unique_ptr<transport::Sink>>, const RelayOptions&,
               std::ostream& err);

}  // namespace trk_bridge::tools
