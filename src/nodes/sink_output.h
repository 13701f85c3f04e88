// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One sink of ros_to_trk, with its diagnostics.
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

/// write() belongs to one thread, describe() to the thread of the diagnostics.
class SinkOutput {
 public:
  /// `form` has the defaults for options that the endpoint does not set. A sink that can block is opened in its own
  /// thread, and describe() reports if that fails. Throws TransportError for other sinks.
  SinkOutput(const transport::SinkEndpoint&, const transport::SinkForm& form);
  /// Closes it, and logs an error if that fails.
  ~SinkOutput();
  SinkOutput(const SinkOutput&) = delete;
  SinkOutput& operator=(const SinkOutput&) = delete;

  void write(const wire::Record& record, const transport::RecordTime& time) { outlet_.write(record, time); }
  /// Accepts no more records; does not wait.
  void finish() { outlet_.finish(); }

  /// The first finding of each kind is also logged. `departures` are those of this sink.
  bridge::Status describe(const std::optional<bridge::DepartureStatistics>& departures);

  const std::string& url() const noexcept { return outlet_.url(); }
  /// The form of the endpoint with the defaults.
  const transport::SinkForm& form() const noexcept { return outlet_.form(); }

 private:
  bridge::Outlet outlet_;
  StatusReporter<bridge::SinkReport> reporter_;
};

/// All sinks of a node. Their destructor lets them finish at the same time.
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
