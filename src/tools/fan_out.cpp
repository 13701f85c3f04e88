#include "fan_out.h"

#include <ostream>
#include <variant>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::tools {
namespace {

using bridge::OutletReason;
using camera::CameraReason;
using transport::SinkFault;
using transport::SinkReason;

/// How bad a loss is, and its words: those of the first time, and those of the summary.
struct LossText {
  bool is_failure;
  std::string first, summary;
};

LossText text_of(const SinkFault& fault, const bridge::Loss&, const transport::SinkForm&) {
  const bool is_waiting = fault.reason == SinkReason::no_constants;
  const auto why = transport::describe(fault);
  return {!is_waiting, why + (is_waiting ? "; they are left out until constants come" : " (told once)"), why};
}

LossText text_of(CameraReason reason, const bridge::Loss& loss, const transport::SinkForm& form) {
  const auto why = camera::describe(reason);
  const auto words = form.format ? wire::format_to_words(*form.format) : std::string("as received");
  return {true, "id " + std::to_string(loss.id) + ": cannot be passed on as \"" + words + "\": " + why + " (told once)",
          why};
}

LossText text_of(OutletReason reason, const bridge::Loss&, const transport::SinkForm&) {
  const auto why = describe(reason);
  return {reason != OutletReason::outdated, why + " (told once)", why};
}

}  // namespace

FanOut::FanOut(std::string program, std::ostream& err, bool source_can_wait)
    : program_(std::move(program)), err_(err), source_can_wait_(source_can_wait) {}

void FanOut::add(const transport::SinkEndpoint& endpoint, const transport::SinkForm& defaults) {
  bridge::OutletOptions options;
  options.defaults = defaults;
  options.caller_can_wait = source_can_wait_;
  options.listener = [this, sink = outlets_.size()](const bridge::Loss& loss) { count(sink, loss); };
  outlets_.push_back(std::make_unique<bridge::Outlet>(endpoint, options));
}

void FanOut::write(const wire::CameraParams& params) {
  for (const auto& outlet : outlets_) outlet->write(params);
}

void FanOut::write(const wire::CameraConstants& constants) {
  for (const auto& outlet : outlets_) outlet->write(constants);
}

void FanOut::count(std::size_t sink, const bridge::Loss& loss) {
  const auto& outlet = *outlets_[sink];
  const std::lock_guard<std::mutex> lock(mutex_);
  if (causes_[{sink, loss.cause}]++ != 0) return;
  const auto text = std::visit([&](const auto& cause) { return text_of(cause, loss, outlet.form()); }, loss.cause);
  if (text.is_failure) is_good_ = false;
  err_ << program_ << ": " << outlet.name() << ": " << text.first << '\n';
}

void FanOut::report(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  err_ << program_ << ": " << line << '\n';
}

void FanOut::close() {
  for (const auto& outlet : outlets_) {
    const auto closed = outlet->close();
    if (closed) continue;
    const auto why = closed.error().reason == SinkReason::no_constants ? "no constants came, so nothing was kept"
                                                                       : transport::describe(closed.error());
    report("error: " + outlet->name() + ": " + why);
    const std::lock_guard<std::mutex> lock(mutex_);
    is_good_ = false;
  }
}

void FanOut::summarise() const {
  for (const auto& outlet : outlets_) {
    const auto sent = outlet->statistics().sent;
    err_ << program_ << ": sent to " << outlet->name() << ": " << sent.params << " parameters, " << sent.constants
         << " constants, " << sent.errors << " errors\n";
  }
  for (const auto& [cause, times] : causes_) {
    const auto& outlet = *outlets_[cause.first];
    const auto why = std::visit([&](const auto& one) { return text_of(one, {}, outlet.form()).summary; }, cause.second);
    if (std::holds_alternative<SinkFault>(cause.second)) {
      if (times > 1) err_ << program_ << ": " << outlet.name() << ": " << times << " times: " << why << '\n';
    } else {
      err_ << program_ << ": " << outlet.name() << ": not passed on: " << times << " records: " << why << '\n';
    }
  }
}

}  // namespace trk_bridge::tools
