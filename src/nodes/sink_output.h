// One sink of ros_to_trk: written to, watched, told of.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "finding_log.h"
#include "ros/ros_to_trk_parameters.h"
#include "ros/outgoing.h"
#include "ros/outgoing_diagnostics.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/base/snapshot.h"

namespace trk_bridge::nodes {

/// write() belongs to one thread, describe() to the diagnostics' one.
class SinkOutput {
 public:
  /// Opens the sink. Throws TransportError.
  explicit SinkOutput(const transport::SinkEndpoint&);
  /// Closes it; a sink that cannot be closed orderly is told in the log.
  ~SinkOutput();
  SinkOutput(const SinkOutput&) = delete;
  SinkOutput& operator=(const SinkOutput&) = delete;

  /// Writes a set that has parameters. Constants that could not be written go before every later set until they could.
  void write(const trk_bridge::ros1::Outgoing&, std::int64_t now);

  /// Findings of a kind that was not met before go to the log, too.
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);

  const std::string& url() const noexcept { return url_; }

 private:
  std::string url_;
  std::unique_ptr<transport::Sink> sink_;
  std::string name_;
  std::optional<wire::CameraConstants> pending_;
  trk_bridge::ros1::SinkState state_;
  base::Snapshot<trk_bridge::ros1::SinkState> published_;
  trk_bridge::ros1::SinkReport last_report_;
  FindingLog log_;
};

}  // namespace trk_bridge::nodes
