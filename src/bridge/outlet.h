// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One sink of a program. A slow sink does not delay the others.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "outlet_queue.h"
#include "outlet_writer.h"

namespace trk_bridge::bridge {

struct OutletOptions {
  transport::SinkForm defaults;  ///< for options that the endpoint does not set
  Feed feed = Feed::passed_on;
  /// If set, the records are not live: write() waits for room in the queue, and close() for the sink, as long as this
  /// returns true. Called by any thread.
  std::function<bool()> may_wait;
  /// The constructor opens the sink, and throws if it cannot be opened.
  bool must_open = false;
  LossListener listener;  ///< called in the caller's thread and in that of the outlet, one at a time
};

/// The state of an outlet, for people.
struct OutletState {
  std::string name;             ///< Sink::name
  std::string notice;           ///< Sink::notice
  bool is_open = false;         ///< it was opened, or records were written
  std::string cannot_open;      ///< why the last attempt to open failed; empty: it did not fail
  std::int64_t busy_since = 0;  ///< steady clock, ns: start of the current open, write or close; 0: it is idle
};

/// A sink whose writes never block is written in the caller's thread. Every other sink has a queue and a thread, which
/// also opens it and retries every second while that fails. While shared memory is being attached, the oldest sets are
/// dropped; if storage does not keep up, the recording ends.
///
/// write(), finish() and close() may be called by one thread at a time, the other functions by any.
class Outlet {
 public:
  /// Throws the TransportError of the endpoint, and with OutletOptions::must_open that of Sink::prepare.
  Outlet(const transport::SinkEndpoint&, const OutletOptions&);
  /// Calls close() and ignores the result.
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  /// See OutletWriter.
  void write(const wire::CameraConstants&);
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  void write(const wire::Record&, const transport::RecordTime& time = {});
  /// Accepts no more records. Does not wait, so that several outlets can finish at the same time before they are
  /// closed.
  void finish();
  /// Writes what is queued, then closes the sink. If one open, write or close of a recording, or all remaining work on
  /// a segment, takes longer than `patience` (and OutletOptions::may_wait does not extend it), the thread is abandoned:
  /// the result is no_answer, and unwritten() is the number of missing records. The abandoned thread runs on until the
  /// program ends, and does not call the listener. Closing again does nothing.
  [[nodiscard]] transport::WriteResult close();

  OutletStatistics statistics() const noexcept;
  OutletState state() const;
  /// None if there is no queue.
  std::optional<OutletQueueStatistics> queue() const;
  /// Records that were accepted but are not written yet.
  std::uint64_t unwritten() const;

  const std::string& url() const noexcept { return url_; }
  /// Sink::name, for people.
  std::string name() const;
  /// The form of the endpoint with the defaults.
  const transport::SinkForm& form() const noexcept { return form_; }

  static constexpr std::chrono::milliseconds patience{500};

 private:
  class Work;

  template <typename Record, typename... Time>
  void pass(const Record&, const Time&... time);
  void abandon();

  const std::string url_;
  const transport::SinkForm form_;
  const std::function<bool()> may_wait_;
  const bool every_set_counts_;
  const std::shared_ptr<Work> work_;  // the thread may outlive the outlet
  std::thread thread_;
  std::int64_t finished_ = 0;  // steady clock, ns: when finish() was called; 0: it was not
  bool is_abandoned_ = false;
};

}  // namespace trk_bridge::bridge
