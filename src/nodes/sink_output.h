// One sink of ros_to_trk: written to, watched, reported.
#pragma once

#include "bridge/outgoing_diagnostics.h"
#include "bridge/outgoing_set.h"
#include "bridge/outlet.h"
#include "status_reporter.h"

namespace trk_bridge::nodes {

/// write() belongs to one thread, describe() to the diagnostics' one.
class SinkOutput {
 public:
  /// Opens the sink; `form` is used for what the endpoint does not say. Throws TransportError.
  SinkOutput(const transport::SinkEndpoint&, const transport::SinkForm& form);
  /// Closes it, and logs an error where that fails.
  ~SinkOutput();
  SinkOutput(const SinkOutput&) = delete;
  SinkOutput& operator=(const SinkOutput&) = delete;

  void write(const bridge::OutgoingSet&);

  /// Findings of a kind that was not met before go to the log, too.
  bridge::Status describe();

  const std::string& url() const noexcept { return outlet_.url(); }

 private:
  bridge::Outlet outlet_;
  StatusReporter<bridge::SinkReport> reporter_;
};

}  // namespace trk_bridge::nodes
