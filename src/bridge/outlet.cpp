#include "outlet.h"

#include <cstddef>
#include <utility>
#include <variant>

namespace trk_bridge::bridge {
namespace {

using transport::Blocking;

/// More than the 200 ms that a half-made segment is waited for, up to 250 sets a second; older sets are of no use.
constexpr std::size_t attaching_capacity = 64;
/// A disk that wakes up or a share that reconnects takes seconds: 10 s at 1000 sets a second, 200 s at 50. 3 MB.
constexpr std::size_t storage_capacity = 10'000;

WhenFull when_full(Blocking blocking, bool caller_can_wait) noexcept {
  if (caller_can_wait) return WhenFull::wait;
  return blocking == Blocking::storage ? WhenFull::fail : WhenFull::drop_oldest;
}

/// What a push cost; none where it cost nothing.
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

}  // namespace

Outlet::Outlet(const transport::SinkEndpoint& endpoint, const OutletOptions& options)
    : Outlet(endpoint, options, endpoint.open()) {}

Outlet::Outlet(const transport::SinkEndpoint& endpoint, const OutletOptions& options,
               std::unique_ptr<transport::Sink> sink)
    : url_(endpoint.url),
      name_(sink->name()),
      form_(transport::with_defaults(endpoint.form, options.defaults)),
      listener_(options.listener),
      writer_(std::move(sink), form_, options.feed, options.listener) {
  if (endpoint.blocking == Blocking::never) return;
  queue_.emplace(endpoint.blocking == Blocking::storage ? storage_capacity : attaching_capacity,
                 when_full(endpoint.blocking, options.caller_can_wait));
  thread_ = std::thread([this] { run(); });
}

Outlet::~Outlet() { static_cast<void>(close()); }

void Outlet::run() {
  while (const auto record = queue_->pop()) {
    std::visit([this](const auto& one) { writer_.write(one); }, *record);
  }
}

template <typename Record>
void Outlet::pass(const Record& record) {
  // Once it is closed, the sink says so.
  if (!thread_.joinable()) return writer_.write(record);
  const auto reason = loss_of(queue_->push(record));
  if (reason && listener_) listener_({record.id, *reason});
}

void Outlet::write(const wire::CameraConstants& constants) { pass(constants); }
void Outlet::write(const wire::CameraParams& params) { pass(params); }

transport::Written Outlet::close() {
  if (thread_.joinable()) {
    queue_->close();
    thread_.join();
  }
  return writer_.close();
}

std::optional<OutletQueueStatistics> Outlet::queue() const {
  if (!queue_) return std::nullopt;
  return queue_->statistics();
}

}  // namespace trk_bridge::bridge
