// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writes to several sinks. A sink that refuses records or is slow does not affect the others.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bridge/departures.h"
#include "bridge/outlet.h"

namespace trk_bridge::tools {

/// Reports each cause of a loss once, in the thread where it happens, and counts it. The functions are for one thread
/// at a time.
class FanOut {
 public:
  /// `may_wait`: see OutletOptions.
  explicit FanOut(std::ostream& err, std::function<bool()> may_wait = {}) : err_(err), may_wait_(std::move(may_wait)) {}

  /// Opens a sink. `defaults` are used for options that the endpoint does not set. Throws TransportError; also for a
  /// sink with a delay or a lead if the source is not live (may_wait).
  void add(const transport::SinkEndpoint&, const transport::SinkForm& defaults);

  /// Call after all sinks are added.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  void write(const wire::CameraConstants&);
  /// Writes what is queued or delayed, and closes all sinks at the same time. With `got_nothing`, a file without
  /// constants is not a failure: there was nothing to write.
  void close(bool got_nothing = false);

  /// Prints a line on `err` that is not mixed with those of other threads. Any thread.
  void report(const std::string& line);
  /// After close(): whether every sink accepted everything. Records before the constants of a file, before the reader
  /// of a FIFO, and sets in shared memory that newer ones replaced are reported and counted, but are not a failure.
  bool is_good() const noexcept { return is_good_; }
  /// After close(): prints what was sent, one line per sink, and how often each cause occurred.
  void summarise() const;
  /// For further output after close().
  std::ostream& err() const noexcept { return err_; }

  const std::vector<std::unique_ptr<bridge::Outlet>>& outlets() const noexcept { return outlets_; }

 private:
  using Cause = std::pair<std::size_t, bridge::Loss::Cause>;  // which sink, and why

  void count(std::size_t sink, const bridge::Loss&);
  bridge::Departures& departures();

  std::ostream& err_;
  const std::function<bool()> may_wait_;
  std::mutex mutex_;  // protects err_, causes_ and is_good_ until close()
  std::map<Cause, std::uint64_t> causes_;
  bool is_good_ = true;
  std::vector<std::unique_ptr<bridge::Outlet>> outlets_;
  std::optional<bridge::Departures> departures_;  // created with the first record
};

}  // namespace trk_bridge::tools
