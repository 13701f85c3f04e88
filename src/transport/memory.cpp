#include "memory.h"

#include <sys/eventfd.h>

#include <cerrno>
#include <ctime>
#include <map>
#include <system_error>
#include <utility>

#include "backends.h"
#include "readable.h"
#include "trk_bridge/transport/snapshot.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::transport {

namespace {

struct Counts {
  std::uint64_t records = 0, malformed = 0, unknown_format_bits = 0;
  Event end = Event::sample;  // ended and failed stay
  int error = 0;              // errno that ended the source
};

class MemorySource final : public Source {
 public:
  explicit MemorySource(const std::string& name) : name_("memory " + name), queue_(MemoryQueue::named(name)) {}

  Event receive(Reception& into, std::chrono::nanoseconds wait) override {
    const Deadline deadline(wait);
    for (;;) {
      if (stop_.is_set()) return Event::stopped;
      if (counts_.end != Event::sample) return counts_.end;
      if (const auto entry = queue_->pop()) {
        into = entry->reception;
        return count(*entry);
      }
      switch (wait_readable(queue_->fd(), stop_, deadline)) {
        case Wake::readable:
          break;
        case Wake::stopped:
          return Event::stopped;
        case Wake::timeout:
          return Event::idle;
        case Wake::failed:
          counts_.error = errno;
          return end(Event::failed);
      }
    }
  }

  void stop() noexcept override { stop_.set(); }

  SourceStatistics statistics() const override {
    const Counts counts = published_.load();
    SourceStatistics s;
    s.records = counts.records;
    s.malformed = counts.malformed;
    s.unknown_format_bits = counts.unknown_format_bits;
    if (counts.end == Event::failed) {
      s.state = SourceState::failed;
      s.error =
          name_ + ": " +
          (counts.error != 0 ? std::generic_category().message(counts.error) : "a failure was put into the queue");
    } else if (counts.end == Event::ended) {
      s.state = SourceState::ended;
    } else if (counts.records > 0) {
      s.state = SourceState::receiving;
    } else if (counts.malformed > 0) {
      s.state = SourceState::nothing_valid;
    } else {
      s.waiting_for = name_ + ": nothing written yet";
    }
    return s;
  }

  std::string name() const override { return name_; }

 private:
  Event count(const MemoryQueue::Entry& entry) noexcept {
    if (entry.event == Event::ended || entry.event == Event::failed) return end(entry.event);
    if (entry.event == Event::malformed) ++counts_.malformed;
    if (entry.event == Event::sample) {
      ++counts_.records;
      const auto* params = std::get_if<wire::CameraParams>(&entry.reception.sample.record);
      if (params != nullptr && (params->format & ~wire::known_format_bits) != 0) ++counts_.unknown_format_bits;
    }
    published_.store(counts_);
    return entry.event;
  }

  Event end(Event event) noexcept {
    counts_.end = event;
    published_.store(counts_);
    return event;
  }

  const std::string name_;
  const std::shared_ptr<MemoryQueue> queue_;
  StopEvent stop_;
  Counts counts_;
  Snapshot<Counts> published_;
};

class MemorySink final : public Sink {
 public:
  explicit MemorySink(const std::string& name) : name_("memory " + name), queue_(MemoryQueue::named(name)) {}

  tl::expected<void, SinkFault> write(const wire::CameraParams& params) override {
    return put(params, &SinkStatistics::params);
  }

  tl::expected<void, SinkFault> write(const wire::CameraConstants& constants) override {
    const auto [last, is_new] = last_constants_.try_emplace(constants.id, constants);
    if (queue_ != nullptr && !is_new && last->second == constants) return {};
    last->second = constants;
    return put(constants, &SinkStatistics::constants);
  }

  tl::expected<void, SinkFault> close() override {
    queue_.reset();
    return {};
  }

  SinkStatistics statistics() const override { return published_.load(); }
  std::string name() const override { return name_; }

 private:
  tl::expected<void, SinkFault> put(const wire::Record& record, std::uint64_t SinkStatistics::*sent) {
    if (queue_ == nullptr) {
      ++counts_.errors;
      published_.store(counts_);
      return tl::make_unexpected(SinkFault{SinkReason::closed});
    }
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    MemoryQueue::Entry entry;
    entry.reception.sample.record = record;
    entry.reception.sample.arrival = static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
    entry.reception.sample.sender.kind = SenderKind::memory;
    queue_->push(entry);
    ++(counts_.*sent);
    published_.store(counts_);
    return {};
  }

  const std::string name_;
  std::shared_ptr<MemoryQueue> queue_;                             // none when closed
  std::map<std::uint32_t, wire::CameraConstants> last_constants_;  // by id
  SinkStatistics counts_;
  Snapshot<SinkStatistics> published_;
};

}  // namespace

MemoryQueue::MemoryQueue() : available_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)) {
  if (!available_.is_open()) {
    throw TransportError("no descriptor for waiting: " + std::generic_category().message(errno));
  }
}

std::shared_ptr<MemoryQueue> MemoryQueue::named(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<MemoryQueue>> queues;
  const std::lock_guard<std::mutex> lock(mutex);
  auto& known = queues[name];
  auto queue = known.lock();
  if (queue == nullptr) known = queue = std::make_shared<MemoryQueue>();
  return queue;
}

void MemoryQueue::push(const Entry& entry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  entries_.push_back(entry);
  if (::eventfd_write(available_.get(), 1) != 0) {
    entries_.pop_back();
    throw TransportError("the queue is full: " + std::generic_category().message(errno));
  }
}

std::optional<MemoryQueue::Entry> MemoryQueue::pop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (entries_.empty()) return {};
  Entry entry = entries_.front();
  entries_.pop_front();
  eventfd_t taken = 0;
  // Each entry added one, so that there is one to take.
  (void)::eventfd_read(available_.get(), &taken);
  return entry;
}

std::unique_ptr<Source> open_memory_source(const MemoryEndpoint& endpoint) {
  return std::make_unique<MemorySource>(endpoint.name);
}

std::unique_ptr<Sink> open_memory_sink(const MemoryEndpoint& endpoint) {
  return std::make_unique<MemorySink>(endpoint.name);
}

}  // namespace trk_bridge::transport
