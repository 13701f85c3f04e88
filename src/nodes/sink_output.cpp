#include "sink_output.h"

#include <ros/console.h>

#include "base/clock.h"

namespace trk_bridge::nodes {
namespace {

bridge::OutletOptions options_for(const transport::SinkForm& form) {
  bridge::OutletOptions options;
  options.defaults = form;
  options.rules.one_camera = true;
  options.rules.only_cameras = true;
  return options;
}

}  // namespace

SinkOutput::SinkOutput(const transport::SinkEndpoint& endpoint, const transport::SinkForm& form)
    : outlet_(endpoint, options_for(form)), log_(outlet_.name()) {
  last_report_.time = base::steady_now();
}

SinkOutput::~SinkOutput() {
  if (const auto closed = outlet_.close(); !closed) {
    ROS_ERROR_STREAM(outlet_.name() << " was not closed in order: " << transport::describe(closed.error()));
  }
}

void SinkOutput::write(const bridge::OutgoingSet& set) {
  if (set.constants) outlet_.write(*set.constants);
  outlet_.write(set.params);
}

bridge::Status SinkOutput::describe() {
  auto report = bridge::report_of(outlet_, base::steady_now());
  const auto found = bridge::findings(report, last_report_);
  bridge::Status status;
  bridge::fill(status, found, report, last_report_);
  log_.write(found);
  last_report_ = std::move(report);
  return status;
}

}  // namespace trk_bridge::nodes
