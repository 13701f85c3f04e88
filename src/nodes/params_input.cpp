#include "params_input.h"

#include "base/clock.h"

namespace trk_bridge::nodes {

ParamsInput::ParamsInput(::ros::NodeHandle node, const trk_bridge::ros1::RosToTrkParameters& parameters,
                         SetWriter write)
    : write_(std::move(write)),
      form_(parameters.form),
      converter_(parameters.form, parameters.constants),
      log_(parameters.name) {
  statistics_.store(converter_.statistics());
  last_report_.time = base::steady_now();
  const auto queue = static_cast<std::uint32_t>(parameters.queue_size);
  const auto no_delay = ::ros::TransportHints().tcpNoDelay();
  constants_ = node.subscribe<trk_bridge::CameraConstants>(
      "constants", queue, [this](const trk_bridge::CameraConstantsConstPtr& message) { take(*message); },
      ::ros::VoidConstPtr(), no_delay);
  params_ = node.subscribe<trk_bridge::CameraParams>(
      "params", queue, [this](const trk_bridge::CameraParamsConstPtr& message) { take(*message); },
      ::ros::VoidConstPtr(), no_delay);
}

void ParamsInput::take(const trk_bridge::CameraConstants& message) {
  converter_.take(message);
  statistics_.store(converter_.statistics());
}

void ParamsInput::take(const trk_bridge::CameraParams& message) {
  const auto outgoing = converter_.take(message, base::steady_now());
  if (outgoing.params) write_(outgoing);
  statistics_.store(converter_.statistics());
}

void ParamsInput::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  trk_bridge::ros1::ParamsReport report{statistics_.load(), params_.getTopic(), base::steady_now()};
  const auto found = trk_bridge::ros1::findings(report, last_report_);
  trk_bridge::ros1::fill(status, found, report, last_report_, form_);
  log_.tell(found);
  last_report_ = std::move(report);
}

}  // namespace trk_bridge::nodes
