// A source that says what a test wants, to its end.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "memory.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::test {

class MemoryFeed {
 public:
  MemoryFeed() : name_("feed " + std::to_string(++count())), queue_(transport::MemoryQueue::named(name_)) {}

  void put(const wire::Record& record, std::uint32_t port = 5000) {
    transport::MemoryQueue::Entry entry;
    entry.reception.sample.record = record;
    entry.reception.sample.sender = sender(port);
    queue_->push(entry);
  }
  void put_malformed(wire::Reason reason) {
    transport::MemoryQueue::Entry entry;
    entry.event = transport::Event::malformed;
    entry.reception.sample.sender = sender(5000);
    entry.reception.fault = wire::Fault{reason};
    queue_->push(entry);
  }
  void put(transport::Event event) {
    transport::MemoryQueue::Entry entry;
    entry.event = event;
    queue_->push(entry);
  }

  std::unique_ptr<transport::Source> source() const {
    return transport::open_source(transport::Endpoint(transport::MemoryEndpoint{name_}));
  }

 private:
  static int& count() {
    static int feeds = 0;
    return feeds;
  }
  static transport::Sender sender(std::uint32_t port) {
    transport::Sender sender;
    sender.kind = transport::SenderKind::ipv4;
    sender.address = {127, 0, 0, 1};
    sender.number = port;
    return sender;
  }

  std::string name_;
  std::shared_ptr<transport::MemoryQueue> queue_;
};

}  // namespace trk_bridge::test
