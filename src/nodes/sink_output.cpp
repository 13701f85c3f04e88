#include "sink_output.h"

#include <ros/console.h>

#include "base/clock.h"

namespace trk_bridge::nodes {
namespace {

bridge::OutletOptions options_for(const transport::SinkForm& form) {
  bridge::OutletOptions options;
  options.defaults = form;
  options.feed = bridge::Feed::one_camera;
  return options;
}

}  // namespace

SinkOutput::SinkOutput(const transport::SinkEndpoint& endpoint, const transport::SinkForm& form)
    : outlet_(endpoint, options_for(form)), reporter_(outlet_.name()) {}

SinkOutput::~SinkOutput() {
  if (const auto closed = outlet_.close(); !closed) {
    ROS_ERROR_STREAM(outlet_.name() << " was not closed in order: " << transport::describe(closed.error()));
  }
}

void SinkOutput::write(const bridge::OutgoingSet& set) {
  if (set.constants) outlet_.write(*set.constants);
  outlet_.write(set.params);
}

bridge::Status SinkOutput::describe() { return reporter_.status(bridge::report_of(outlet_, base::steady_now())); }

}  // namespace trk_bridge::nodes
