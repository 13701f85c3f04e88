// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A source that gives the events that a test has put in.
#pragma once

#include <memory>

#include "memory.h"

namespace trk_bridge::test {

class MemoryFeed {
 public:
  /// A sender on the loopback.
  static transport::Sender sender(std::uint32_t port) { return {transport::SenderKind::ipv4, {127, 0, 0, 1}, port}; }

  void put(const wire::Record& record, std::uint32_t port = 5000) {
    MemoryQueue::Entry entry;
    entry.reception.sample.record = record;
    entry.reception.sample.sender = sender(port);
    entry.reception.sample.origin = "ASCII";
    queue_->push(entry);
  }
  void put_without_lens(const wire::CameraParams& params, const char* doubt = "") {
    MemoryQueue::Entry entry;
    entry.reception.sample.record = params;
    entry.reception.sample.sender = sender(5000);
    entry.reception.sample.has_lens = entry.reception.sample.has_counter = false;
    entry.reception.sample.doubt = doubt;
    queue_->push(entry);
  }
  void put_malformed(wire::Reason reason) {
    MemoryQueue::Entry entry;
    entry.event = transport::Event::malformed;
    entry.reception.sample.sender = sender(5000);
    entry.reception.fault = wire::Fault{reason};
    queue_->push(entry);
  }
  void put(transport::Event event) {
    MemoryQueue::Entry entry;
    entry.event = event;
    queue_->push(entry);
  }

  std::unique_ptr<transport::Source> source() const { return std::make_unique<MemorySource>(queue_); }

 private:
  std::shared_ptr<MemoryQueue> queue_ = std::make_shared<MemoryQueue>();
};

}  // namespace trk_bridge::test
