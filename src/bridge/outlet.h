// One sink as a program uses it: records in, and no other sink waits for this one.
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

/// How a program uses a sink.
struct OutletOptions {
  transport::SinkForm defaults;  ///< for what the endpoint does not say
  Feed feed = Feed::passed_on;
  /// Where given, what comes is not live: where there is no room, write() waits for it, and the end of the sink is
  /// waited for, for as long as this says. Any thread calls it.
  std::function<bool()> may_wait;
  /// The constructor opens the sink, and throws where it cannot be opened.
  bool must_open = false;
  LossListener listener;  ///< called in the caller's thread and in the outlet's own, one at a time
};

/// What an outlet does, for a person.
struct OutletState {
  std::string name;             ///< Sink::name
  std::string notice;           ///< Sink::notice
  bool is_open = false;         ///< it was opened, or records went out
  std::string cannot_open;      ///< why the last attempt failed; empty: it did not
  std::int64_t busy_since = 0;  ///< steady clock, ns: since when it opens, writes or closes; 0: it waits for records
};

/// A sink whose writes never wait is written in the caller's thread. The others have a thread and a queue of their own,
/// in which they are opened, too: again every second for as long as that fails. While it attaches to shared memory, the
/// oldest sets are dropped; storage that does not keep up ends the recording.
///
/// write(), finish() and close() are for one thread at a time, the rest for any.
class Outlet {
 public:
  /// Throws TransportError: that of the endpoint, and with OutletOptions::must_open that of Sink::prepare.
  Outlet(const transport::SinkEndpoint&, const OutletOptions&);
  /// As close(), without result.
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  /// See OutletWriter.
  void write(const wire::CameraConstants&);
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  void write(const wire::Record&, const transport::RecordTime& time = {});
  /// From now on nothing is taken. Does not wait: several outlets that are to be closed end at the same time.
  void finish();
  /// Writes what is queued, then ends the sink in order. Where a recording's open, write or close, or all that is left
  /// to do for a segment, takes longer than `patience` (and OutletOptions::may_wait does not say otherwise), it is left
  /// to itself: no_answer, and unwritten() says how much is missing. Its thread goes on for as long as the program
  /// runs, and calls nobody. Closing again does nothing.
  [[nodiscard]] transport::Written close();

  OutletStatistics statistics() const noexcept;
  OutletState state() const;
  /// None where there is no queue.
  std::optional<OutletQueueStatistics> queue() const;
  /// Records that were taken, and have not been written yet.
  std::uint64_t unwritten() const;

  const std::string& url() const noexcept { return url_; }
  /// As a person reads it: Sink::name.
  std::string name() const;
  /// With the defaults filled in.
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
  std::int64_t finished_ = 0;  // steady clock, ns: when it was asked to end; 0: it was not
  bool is_abandoned_ = false;
};

}  // namespace trk_bridge::bridge
