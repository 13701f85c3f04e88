// A queue inside the process that sources and sinks of one name share.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "descriptor.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

/// Unbounded, in order, nothing is lost; what one source takes the others do not see. Lives as long as somebody holds
/// it. Any thread.
class MemoryQueue {
 public:
  struct Entry {
    Event event = Event::sample;  ///< sample, malformed, ended or failed
    Reception reception;
  };

  /// The one of that name, made if there is none. Throws TransportError.
  static std::shared_ptr<MemoryQueue> named(const std::string& name);

  /// Throws TransportError. Rather named().
  MemoryQueue();

  /// Anything that a source can say, at any arrival: what tests need beyond a sink.
  void push(const Entry& entry);
  std::optional<Entry> pop();
  /// Readable while there is something to take.
  int fd() const noexcept { return available_.get(); }

 private:
  std::mutex mutex_;
  std::deque<Entry> entries_;
  Descriptor available_;  // an event descriptor that counts the entries
};

}  // namespace trk_bridge::transport
