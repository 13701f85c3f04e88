#include "fan_out.h"

#include <ostream>
#include <utility>

namespace trk_bridge::tools {

FanOut::FanOut(std::vector<std::unique_ptr<transport::Sink>> sinks, std::string program, std::ostream& err)
    : sinks_(std::move(sinks)), program_(std::move(program)), err_(err) {}

template <typename Record>
void FanOut::write_each(const Record& record) {
  for (std::size_t i = 0; i < sinks_.size(); ++i) {
    if (const auto written = sinks_[i]->write(record); !written) count(i, written.error());
  }
}

void FanOut::write(const wire::CameraParams& params) { write_each(params); }
void FanOut::write(const wire::CameraConstants& constants) { write_each(constants); }

void FanOut::count(std::size_t sink, const transport::SinkFault& fault) {
  const bool is_waiting = fault.reason == transport::SinkReason::no_constants;
  if (!is_waiting) is_good_ = false;
  if (causes_[{sink, fault}]++ != 0) return;
  err_ << program_ << ": " << sinks_[sink]->name() << ": " << transport::describe(fault)
       << (is_waiting ? "; they are left out until constants come\n" : " (told once)\n");
}

void FanOut::close() {
  for (const auto& sink : sinks_) {
    const auto closed = sink->close();
    if (closed) continue;
    is_good_ = false;
    err_ << program_ << ": error: " << sink->name() << ": "
         << (closed.error().reason == transport::SinkReason::no_constants ? "no constants came, so nothing was kept"
                                                                          : transport::describe(closed.error()))
         << '\n';
  }
}

void FanOut::summarise() const {
  for (const auto& sink : sinks_) {
    const auto sent = sink->statistics();
    err_ << program_ << ": sent to " << sink->name() << ": " << sent.params << " parameters, " << sent.constants
         << " constants, " << sent.errors << " errors\n";
  }
  for (const auto& [cause, times] : causes_) {
    if (times == 1) continue;
    err_ << program_ << ": " << sinks_[cause.first]->name() << ": " << times
         << " times: " << transport::describe(cause.second) << '\n';
  }
}

}  // namespace trk_bridge::tools
