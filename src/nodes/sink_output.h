// One sink of ros_to_trk: written to, watched, reported.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bridge/outgoing_diagnostics.h"
#include "bridge/outlet.h"
#include "status_reporter.h"

namespace trk_bridge::nodes {

/// write() belongs to one thread, describe() to the diagnostics' one.
class SinkOutput {
 public:
  /// `form` is used for what the endpoint does not say. What can block is opened in a thread of its own, and that it
  /// cannot be opened is in describe(). Throws TransportError for the others.
  SinkOutput(const transport::SinkEndpoint&, const transport::SinkForm& form);
  /// Closes it, and logs an error where that fails.
  ~SinkOutput();
  SinkOutput(const SinkOutput&) = delete;
  SinkOutput& operator=(const SinkOutput&) = delete;

  void write(const wire::Record& record, const transport::RecordTime& time) { outlet_.write(record, time); }
  /// Nothing is written any more; does not wait.
  void finish() { outlet_.finish(); }

  /// Findings of a kind that was not met before go to the log, too.
  /// `departures` are its own.
  bridge::Status describe(const std::optional<bridge::DepartureStatistics>& departures);

  const std::string& url() const noexcept { return outlet_.url(); }
  /// With the defaults filled in.
  const transport::SinkForm& form() const noexcept { return outlet_.form(); }

 private:
  bridge::Outlet outlet_;
  StatusReporter<bridge::SinkReport> reporter_;
};

/// All sinks of a node. They end at the same time.
class SinkOutputs {
 public:
  SinkOutputs() = default;
  ~SinkOutputs();
  SinkOutputs(const SinkOutputs&) = delete;
  SinkOutputs& operator=(const SinkOutputs&) = delete;

  void add(const transport::SinkEndpoint& endpoint, const transport::SinkForm& form) {
    sinks_.push_back(std::make_unique<SinkOutput>(endpoint, form));
  }
  const std::vector<std::unique_ptr<SinkOutput>>& all() const noexcept { return sinks_; }

 private:
  std::vector<std::unique_ptr<SinkOutput>> sinks_;
};

}  // namespace trk_bridge::nodes
