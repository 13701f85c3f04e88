// One sink as a program uses it: records in, and no other sink waits for this one.
#pragma once

#include <cstdint>
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
  bool caller_can_wait = false;  ///< where there is no room, write() waits for it: for what is not live
  LossListener listener;         ///< called in the caller's thread and in the outlet's own
};

/// Opened by its constructor. A sink whose writes never wait is written in the caller's thread. The others have a
/// thread and a queue of their own: while it attaches to shared memory, the oldest sets are dropped; storage that does
/// not keep up ends the recording.
///
/// write() and close() are for one thread at a time, the rest for any.
class Outlet {
 public:
  /// Throws TransportError.
  Outlet(const transport::SinkEndpoint&, const OutletOptions&);
  /// As close(), without result.
  ~Outlet();
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;

  /// See OutletWriter.
  void write(const wire::CameraConstants&);
  void write(const wire::CameraParams&);
  /// Writes what is queued, then ends the sink in order. Closing again does nothing.
  [[nodiscard]] transport::Written close();

  OutletStatistics statistics() const noexcept { return writer_.statistics(); }
  /// None where there is no queue.
  std::optional<OutletQueueStatistics> queue() const;

  const std::string& url() const noexcept { return url_; }
  /// As a person reads it: Sink::name.
  const std::string& name() const noexcept { return name_; }
  /// With the defaults filled in.
  const transport::SinkForm& form() const noexcept { return form_; }

 private:
  Outlet(const transport::SinkEndpoint&, const OutletOptions&, std::unique_ptr<transport::Sink>);
  template <typename Record>
  void pass(const Record&);
  void run();

  const std::string url_, name_;
  const transport::SinkForm form_;
  const LossListener listener_;
  OutletWriter writer_;
  std::optional<OutletQueue> queue_;
  std::thread thread_;
};

}  // namespace trk_bridge::bridge
