// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "fan_out.h"

#include <ostream>
#include <utility>
#include <variant>

#include "base/clock.h"
#include "bridge/outgoing_diagnostics.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

using bridge::OutletReason;
using camera::CameraReason;
using transport::SinkFault;
using transport::SinkReason;

using Cause = bridge::Loss::Cause;

std::string why(const Cause& cause) {
  return std::visit([](const auto& one) { return describe(one); }, cause);
}

bool is_failure(const Cause& cause) {
  if (const auto* fault = std::get_if<SinkFault>(&cause)) {
    return fault->reason != SinkReason::no_constants && fault->reason != SinkReason::no_reader;
  }
  if (const auto* reason = std::get_if<OutletReason>(&cause)) return *reason != OutletReason::outdated;
  return true;
}

/// The report of the first loss with this cause.
std::string first_report(const bridge::Loss& loss, const transport::SinkForm& form) {
  const auto* fault = std::get_if<SinkFault>(&loss.cause);
  if (fault != nullptr && fault->reason == SinkReason::no_constants) {
    return why(loss.cause) + "; they are not written until constants arrive";
  }
  std::string once = why(loss.cause) + " (reported once)";
  if (!std::holds_alternative<CameraReason>(loss.cause)) return once;
  const auto words = form.format ? wire::format_to_words(*form.format) : std::string("as received");
  return "id " + std::to_string(loss.id) + ": cannot be passed on as \"" + words + "\": " + once;
}

}  // namespace

void FanOut::add(const transport::SinkEndpoint& endpoint, const transport::SinkForm& defaults) {
  bridge::OutletOptions options;
  options.defaults = defaults;
  options.may_wait = may_wait_;
  options.must_open = true;
  options.listener = [this, sink = outlets_.size()](const bridge::Loss& loss) { count(sink, loss); };
  if (may_wait_ && transport::with_defaults(endpoint.form, defaults).is_timed()) {
    throw transport::TransportError(
        "endpoint \"" + endpoint.url +
        "\": a take that is read as fast as possible cannot be delayed: delay and lead need a live source");
  }
  outlets_.push_back(std::make_unique<bridge::Outlet>(endpoint, options));
}

bridge::Departures& FanOut::departures() {
  if (departures_) return *departures_;
  std::vector<bridge::Destination> destinations;
  for (std::size_t sink = 0; sink < outlets_.size(); ++sink) {
    auto& outlet = *outlets_[sink];
    destinations.push_back({bridge::timing_of(outlet.form()), false,
                            [&outlet](const auto& record, const auto& time) { outlet.write(record, time); },
                            [this, sink](const bridge::Loss& loss) { count(sink, loss); }});
  }
  bridge::DepartureOptions options;
  options.clock = base::wall_now;
  return departures_.emplace(std::move(options), std::move(destinations));
}

void FanOut::write(const wire::CameraParams& params, const transport::RecordTime& time) {
  departures().write(params, time);
}

void FanOut::write(const wire::CameraConstants& constants) { departures().write(constants); }

void FanOut::count(std::size_t sink, const bridge::Loss& loss) {
  const auto& outlet = *outlets_[sink];
  const std::lock_guard<std::mutex> lock(mutex_);
  if (causes_[{sink, loss.cause}]++ != 0) return;
  if (is_failure(loss.cause)) is_good_ = false;
  err_ << "trk: " << outlet.name() << ": " << first_report(loss, outlet.form()) << '\n';
}

void FanOut::report(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  err_ << "trk: " << line << '\n';
}

void FanOut::close(bool got_nothing) {
  if (departures_) departures_->finish();
  for (const auto& outlet : outlets_) outlet->finish();
  for (const auto& outlet : outlets_) {
    const auto closed = outlet->close();
    if (closed) continue;
    const auto lost = outlet->unwritten();
    const bool lacks_constants = closed.error().reason == SinkReason::no_constants;
    if (lacks_constants && got_nothing) continue;
    report(
        "error: " + outlet->name() + ": " +
        (lacks_constants ? "no constants were received, so nothing was written" : transport::describe(closed.error())) +
        (lost > 0 ? "; " + std::to_string(lost) + " queued records are lost" : ""));
    const std::lock_guard<std::mutex> lock(mutex_);
    is_good_ = false;
  }
}

void FanOut::summarise() const {
  for (const auto& outlet : outlets_) {
    const auto sent = outlet->statistics().sent;
    err_ << "trk: sent to " << outlet->name() << ": " << sent.params << " parameters, " << sent.constants
         << " constants, " << sent.errors << " errors\n";
  }
  for (std::size_t sink = 0; departures_ && sink < outlets_.size(); ++sink) {
    const auto timed = departures_->statistics(sink);
    if (!timed) continue;
    err_ << "trk: " << outlets_[sink]->name() << ": " << bridge::timing_text(*timed) << '\n';
  }
  for (const auto& [cause, times] : causes_) {
    const auto& [sink, reason] = cause;
    const auto name = outlets_[sink]->name();
    if (!std::holds_alternative<SinkFault>(reason)) {
      err_ << "trk: " << name << ": not passed on: " << times << " records: " << why(reason) << '\n';
    } else if (times > 1) {
      err_ << "trk: " << name << ": " << times << " times: " << why(reason) << '\n';
    }
  }
}

}  // namespace trk_bridge::tools
