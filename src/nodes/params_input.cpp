#include "params_input.h"

#include "base/clock.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

ParamsInput::ParamsInput(::ros::NodeHandle node, const ros1::RosToTrkParameters& parameters, SetWriter write)
    : write_(std::move(write)), sets_(parameters.constants), log_(parameters.name) {
  statistics_.store(sets_.statistics());
  last_report_.time = base::steady_now();
  const auto queue = static_cast<std::uint32_t>(parameters.queue_size);
  const auto no_delay = ::ros::TransportHints().tcpNoDelay();
  constants_ = node.subscribe<trk_bridge::CameraConstants>(
      "constants", queue, [this](const trk_bridge::CameraConstantsConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay);
  params_ = node.subscribe<trk_bridge::CameraParams>(
      "params", queue, [this](const trk_bridge::CameraParamsConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay);
}

void ParamsInput::receive(const trk_bridge::CameraConstants& message) {
  sets_.use(ros1::from_msg(message));
  statistics_.store(sets_.statistics());
}

void ParamsInput::receive(const trk_bridge::CameraParams& message) {
  write_(sets_.use(ros1::from_msg(message), base::steady_now()));
  statistics_.store(sets_.statistics());
}

bridge::Status ParamsInput::describe() {
  bridge::ParamsReport report{statistics_.load(), params_.getTopic(), base::steady_now()};
  const auto found = bridge::findings(report, last_report_);
  bridge::Status status;
  bridge::fill(status, found, report, last_report_);
  log_.write(found);
  last_report_ = std::move(report);
  return status;
}

}  // namespace trk_bridge::nodes
