// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A source and a sink inside the process, and the queue between them.
#pragma once

#include <sys/eventfd.h>

#include <cerrno>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/clock.h"
#include "transport/counted_source.h"
#include "transport/socket.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::test {

/// Unbounded, in order, without loss; each entry is received by one source only. Any thread.
class MemoryQueue {
 public:
  struct Entry {
    transport::Event event = transport::Event::sample;  ///< sample, malformed, ended or failed
    transport::Reception reception;
  };

  MemoryQueue() : available_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)) {
    if (!available_.is_open()) throw std::runtime_error("no descriptor for waiting");
  }

  void push(const Entry& entry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.push_back(entry);
    if (::eventfd_write(available_.get(), 1) != 0) throw std::runtime_error("the queue is full");
  }
  std::optional<Entry> pop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (entries_.empty()) return {};
    Entry entry = entries_.front();
    entries_.pop_front();
    eventfd_t taken = 0;
    // Each entry added one to the descriptor.
    (void)::eventfd_read(available_.get(), &taken);
    return entry;
  }
  /// Readable while there are entries.
  int fd() const noexcept { return available_.get(); }

 private:
  std::mutex mutex_;
  std::deque<Entry> entries_;
  transport::Descriptor available_;  // an event descriptor that counts the entries
};

class MemorySource final : public transport::CountedSource {
 public:
  explicit MemorySource(std::shared_ptr<MemoryQueue> queue) : CountedSource("memory"), queue_(std::move(queue)) {}

  transport::Event receive(transport::Reception& into, std::chrono::nanoseconds wait) override {
    const transport::Deadline until(wait);
    for (;;) {
      if (const auto end = final_event(); end != transport::Event::sample) return end;
      if (const auto entry = queue_->pop()) {
        into = entry->reception;
        switch (entry->event) {
          case transport::Event::malformed:
            return malformed();
          case transport::Event::ended:
            return ended();
          case transport::Event::failed:
            return failed(EIO);
          default:
            return sample(into.sample);
        }
      }
      switch (transport::wait_readable(queue_->fd(), stop_event(), until)) {
        case transport::Wake::readable:
          break;
        case transport::Wake::stopped:
          return transport::Event::stopped;
        case transport::Wake::timeout:
          return transport::Event::idle;
        case transport::Wake::failed:
          return failed(errno);
      }
    }
  }

 private:
  void complete(transport::SourceStatistics& statistics) const override {
    if (statistics.state == transport::SourceState::waiting) statistics.waiting_for = "memory: nothing written yet";
  }

  const std::shared_ptr<MemoryQueue> queue_;
};

class MemorySink final : public transport::Sink {
 public:
  explicit MemorySink(std::shared_ptr<MemoryQueue> queue) : queue_(std::move(queue)) {}
  std::string name() const override { return "memory"; }

 private:
  transport::WriteResult put(const wire::CameraParams& params) override { return push(params); }
  transport::WriteResult put(const wire::CameraConstants& constants) override { return push(constants); }
  transport::WriteResult finish() override { return {}; }
  transport::WriteResult push(const wire::Record& record) {
    MemoryQueue::Entry entry;
    entry.reception.sample.record = record;
    entry.reception.sample.arrival = base::wall_now();
    entry.reception.sample.sender.kind = transport::SenderKind::memory;
    queue_->push(entry);
    return {};
  }

  const std::shared_ptr<MemoryQueue> queue_;
};

}  // namespace trk_bridge::test
