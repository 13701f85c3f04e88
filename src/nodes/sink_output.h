// One sink of ros_to_trk: written to, watched, reported.
#pragma once

#include "bridge/outgoing_diagnostics.h"
#include "bridge/outgoing_set.h"
#include "bridge/outlet.h"
#include "finding_log.h"

namespace trk_bridge::nodes {

/// write() belongs to one thread, describe() to the diagnostics' one.
class SinkOutput {
 public:
  /// Opens the sink; `form` counts for what the endpoint does not say. Throws TransportError.
  SinkOutput(const transport::SinkEndpoint&, const transport::SinkForm& form);
  /// Closes it; the log says of a sink that cannot be closed in order.
  ~SinkOutput();
  SinkOutput(const SinkOutput&) = delete;
  SinkOutput& operator=(const SinkOutput&) = delete;

  void write(const bridge::OutgoingSet&);

  /// Findings of a kind that was not met before go to the log, too.
  bridge::Status describe();

  const std::string& url() const noexcept { return outlet_.url(); }

 private:
  bridge::Outlet outlet_;
  bridge::SinkReport last_report_;
  FindingLog log_;
};

}  // namespace trk_bridge::nodes
