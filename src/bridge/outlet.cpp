// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "outlet.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <typeinfo>
#include <utility>
#include <variant>

#include <dlfcn.h>

#include "base/clock.h"

namespace trk_bridge::bridge {
namespace {

using std::chrono::milliseconds;
using transport::Blocking;
using transport::SinkFault;
using transport::SinkReason;
using transport::WriteResult;

/// Covers the 200 ms of waiting for a half-created segment at up to 250 sets a second; older sets are of no use.
constexpr std::size_t attaching_capacity = 64;
/// A disk that spins up or a network share that reconnects takes seconds: 10 s at 1000 sets a second, 200 s at 50. 3
/// MB.
constexpr std::size_t storage_capacity = 10'000;
/// How often opening a sink is tried again.
constexpr std::chrono::seconds retry_period{1};
/// How often close() checks whether the thread has ended.
constexpr milliseconds poll_period{20};

WhenFull when_full(Blocking blocking, bool caller_can_wait) noexcept {
  if (caller_can_wait) return WhenFull::wait;
  return blocking == Blocking::storage ? WhenFull::fail : WhenFull::drop_oldest;
}

/// What was lost by a push; none if nothing was.
std::optional<OutletReason> loss_of(Pushed pushed) noexcept {
  switch (pushed) {
    case Pushed::queued:
      return std::nullopt;
    case Pushed::made_room:
      return OutletReason::outdated;
    case Pushed::lost_constants:
      return OutletReason::too_many_ids;
    case Pushed::refused:
      return OutletReason::too_slow;
  }
  return std::nullopt;
}

/// Prevents the library with this address, and those that it depends on, from being unloaded. The libraries of a
/// nodelet are unloaded with it while an abandoned thread still runs their code.
void keep_library_of(const void* address) noexcept {
  Dl_info library{};
  if (::dladdr(address, &library) == 0 || library.dli_fname == nullptr) return;
  ::dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

}  // namespace

/// State shared by an outlet and its thread.
class Outlet::Work {
 public:
  Work(const transport::SinkEndpoint& endpoint, const transport::SinkForm& form, const OutletOptions& options)
      : listener_(options.listener),
        writer_(endpoint.open(), form, options.feed, [this](const Loss& loss) { report(loss); }) {
    if (options.must_open || endpoint.blocking == Blocking::never) {
      writer_.prepare();
      is_open_ = true;
    }
    if (endpoint.blocking == Blocking::never) return;
    queue_.emplace(endpoint.blocking == Blocking::storage ? storage_capacity : attaching_capacity,
                   when_full(endpoint.blocking, static_cast<bool>(options.may_wait)), options.may_wait);
  }

  OutletWriter& writer() noexcept { return writer_; }
  std::optional<OutletQueue>& queue() noexcept { return queue_; }

  void report(const Loss& loss) {
    const std::lock_guard<std::mutex> lock(listener_mutex_);
    if (listener_) listener_(loss);
  }
  /// The listener is not called any more.
  void drop_listener() {
    const std::lock_guard<std::mutex> lock(listener_mutex_);
    listener_ = nullptr;
  }

  /// The main function of the thread.
  void run();

  /// Whether the thread has ended within `wait`.
  bool has_ended(milliseconds wait) {
    std::unique_lock<std::mutex> lock(mutex_);
    return ended_.wait_for(lock, wait, [this] { return closed_.has_value(); });
  }
  /// The result of closing. Call only after has_ended().
  WriteResult closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return *closed_;
  }
  std::int64_t busy_since() const noexcept { return busy_since_.load(); }
  std::uint64_t unwritten() const { return queue_ ? queue_->statistics().queued + (has_record_.load() ? 1 : 0) : 0; }
  OutletState state() const {
    OutletState state{writer_.sink().name(), writer_.sink().notice(), false, {}, busy_since()};
    const std::lock_guard<std::mutex> lock(mutex_);
    state.is_open = is_open_;
    state.cannot_open = cannot_open_;
    return state;
  }

 private:
  /// Runs an action that may take long.
  template <typename Action>
  void step(const Action& action) {
    busy_since_.store(base::steady_now());
    action();
    busy_since_.store(0);
  }
  void try_to_open();
  bool is_open() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_open_;
  }
  void note_open(bool is_open, const std::string& cannot_open) {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_open_ = is_open;
    cannot_open_ = cannot_open;
  }
  void write(const QueuedRecord&);

  std::mutex listener_mutex_;
  LossListener listener_;
  OutletWriter writer_;
  std::optional<OutletQueue> queue_;
  std::atomic<std::int64_t> busy_since_{0};
  std::atomic<bool> has_record_{false};  // one that has left the queue

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable ended_;
  bool is_open_ = false;
  std::string cannot_open_;
  std::optional<WriteResult> closed_;
};

void Outlet::Work::try_to_open() {
  step([this] {
    try {
      writer_.prepare();
      note_open(true, {});
    } catch (const std::exception& error) {
      note_open(false, error.what());
    }
  });
}

void Outlet::Work::write(const QueuedRecord& queued) {
  has_record_.store(true);
  step([&] {
    if (const auto* params = std::get_if<wire::CameraParams>(&queued.record)) {
      writer_.write(*params, queued.time);
    } else {
      writer_.write(std::get<wire::CameraConstants>(queued.record));
    }
  });
  has_record_.store(false);
}

void Outlet::Work::run() {
  const auto is_in_order = [this] { return is_open() && !writer_.statistics().fails; };
  if (!is_in_order()) try_to_open();
  auto next_attempt = std::chrono::steady_clock::now() + retry_period;
  for (bool is_good = is_in_order(); !queue_->is_over();) {
    if (const auto queued = is_good ? queue_->pop() : queue_->pop(retry_period)) {
      write(*queued);
      const auto& written = writer_.statistics();
      if (!is_good && !written.fails && written.sent.params > 0) note_open(true, {});
      is_good = is_in_order();
    }
    // A sink that refuses writes is opened again, too: the error of opening is more specific than that of writing.
    if (const auto now = std::chrono::steady_clock::now(); !is_good && now >= next_attempt) {
      next_attempt = now + retry_period;
      try_to_open();
      is_good = is_in_order();
    }
  }
  WriteResult closed;
  step([&] { closed = writer_.close(); });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = closed;
  }
  ended_.notify_all();
}

Outlet::Outlet(const transport::SinkEndpoint& endpoint, const OutletOptions& options)
    : url_(endpoint.url),
      form_(transport::with_defaults(endpoint.form, options.defaults)),
      may_wait_(options.may_wait),
      every_set_counts_(endpoint.blocking == Blocking::storage),
      work_(std::make_shared<Work>(endpoint, form_, options)) {
  if (work_->queue()) thread_ = std::thread([work = work_] { work->run(); });
}

Outlet::~Outlet() { static_cast<void>(close()); }

template <typename Record, typename... Time>
void Outlet::pass(const Record& record, const Time&... time) {
  if (is_abandoned_) return work_->report({record.id, SinkFault{SinkReason::no_answer}});
  // After close(), the sink reports that it is closed.
  if (!thread_.joinable()) return work_->writer().write(record, time...);
  if (const auto reason = loss_of(work_->queue()->push(record, time...))) work_->report({record.id, *reason});
}

void Outlet::write(const wire::CameraConstants& constants) { pass(constants); }
void Outlet::write(const wire::CameraParams& params, const transport::RecordTime& time) { pass(params, time); }
void Outlet::write(const wire::Record& record, const transport::RecordTime& time) {
  if (const auto* params = std::get_if<wire::CameraParams>(&record)) return write(*params, time);
  write(std::get<wire::CameraConstants>(record));
}

void Outlet::finish() {
  if (!thread_.joinable()) return;
  if (finished_ == 0) finished_ = base::steady_now();
  work_->queue()->close();
}

WriteResult Outlet::close() {
  if (is_abandoned_) return {};
  if (!thread_.joinable()) return work_->queue() ? WriteResult() : work_->writer().close();
  finish();
  for (auto begin = finished_; !work_->has_ended(poll_period);) {
    const auto now = base::steady_now();
    if (may_wait_ && may_wait_()) begin = now;
    const auto busy_since = work_->busy_since();
    if (every_set_counts_ && busy_since == 0) continue;
    const auto since = every_set_counts_ ? std::max(begin, busy_since) : begin;
    if (std::chrono::nanoseconds(now - since) > patience) {
      abandon();
      return transport::refused(SinkReason::no_answer);
    }
  }
  thread_.join();
  return work_->closed();
}

void Outlet::abandon() {
  work_->drop_listener();
  static const char here = 0;
  keep_library_of(&here);
  const transport::Sink& sink = work_->writer().sink();
  keep_library_of(&typeid(sink));
  thread_.detach();
  is_abandoned_ = true;
}

OutletStatistics Outlet::statistics() const noexcept { return work_->writer().statistics(); }
OutletState Outlet::state() const { return work_->state(); }
std::string Outlet::name() const { return work_->writer().sink().name(); }

std::optional<OutletQueueStatistics> Outlet::queue() const {
  if (!work_->queue()) return std::nullopt;
  return work_->queue()->statistics();
}

std::uint64_t Outlet::unwritten() const { return work_->unwritten(); }

}  // namespace trk_bridge::bridge
