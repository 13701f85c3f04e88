#include "sink_output.h"

#include <ros/console.h>

#include "base/clock.h"

namespace trk_bridge::nodes {

SinkOutput::SinkOutput(const transport::SinkEndpoint& endpoint)
    : url_(endpoint.url), sink_(endpoint.open()), name_(sink_->name()), log_(name_) {
  last_report_.time = base::steady_now();
}

SinkOutput::~SinkOutput() {
  if (const auto closed = sink_->close(); !closed) {
    ROS_ERROR_STREAM(name_ << " was not closed orderly: " << transport::describe(closed.error()));
  }
}

void SinkOutput::write(const trk_bridge::ros1::Outgoing& outgoing, std::int64_t now) {
  if (outgoing.constants) pending_ = outgoing.constants;
  tl::expected<void, transport::SinkFault> constants_written;
  if (pending_) constants_written = sink_->write(*pending_);
  if (constants_written) pending_.reset();
  const auto params_written = sink_->write(*outgoing.params);
  state_.counts = sink_->statistics();
  state_.fails = !constants_written || !params_written;
  if (state_.fails) {
    ++state_.failed_sets;
    // A file without constants takes no parameters: why it has none is the cause.
    state_.last_fault = constants_written ? params_written.error() : constants_written.error();
    state_.last_failure = now;
  }
  if (params_written) state_.last_success = now;
  published_.store(state_);
}

void SinkOutput::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  trk_bridge::ros1::SinkReport report{name_, published_.load(), base::steady_now()};
  const auto found = trk_bridge::ros1::findings(report, last_report_);
  trk_bridge::ros1::fill(status, found, report, last_report_);
  log_.tell(found);
  last_report_ = std::move(report);
}

}  // namespace trk_bridge::nodes
