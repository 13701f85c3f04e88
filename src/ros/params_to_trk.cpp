#include "params_to_trk.h"

#include "trk_bridge/ros/messages.h"

namespace trk_bridge::ros1 {

using camera::CameraReason;

ParamsToTrk::ParamsToTrk(const OutgoingForm& form, const std::optional<wire::CameraConstants>& constants)
    : form_(form), outgoing_(form_.format) {
  if (constants) use(*constants);
}

void ParamsToTrk::use(const wire::CameraConstants& constants) {
  incoming_ = constants;
  outgoing_.use(constants);
  statistics_.constants_known = true;
}

void ParamsToTrk::take(const trk_bridge::CameraConstants& message) {
  const auto constants = from_msg(message);
  if (!camera::check(constants)) {
    ++statistics_.bad_constants;
    return;
  }
  use(constants);
  statistics_.constants_received = true;
}

Outgoing ParamsToTrk::take(const trk_bridge::CameraParams& message, std::int64_t now) {
  auto& count = statistics_.outgoing;
  auto params = from_msg(message);
  ++statistics_.received;
  statistics_.last_format = params.format;
  const auto drop = [&count](CameraReason reason) {
    ++count.dropped;
    count.drop_reason = reason;
    return Outgoing{};
  };
  const auto* incoming = incoming_ ? &*incoming_ : nullptr;
  if (const auto pose = camera::decode_pose(params); !pose) return drop(pose.error());
  const auto lens = camera::decode_lens(params, incoming);
  if (!lens && lens.error() == CameraReason::not_finite) return drop(lens.error());
  const auto told = camera::reexpress(params, form_.format, incoming, outgoing_.get());
  if (!told) {
    ++count.withheld;
    count.withhold_reason = told.error();
    return {};
  }
  Outgoing outgoing;
  outgoing.params = *told;
  outgoing.params->id = sent_id(form_, params.id, count);
  outgoing.constants = outgoing_.news(outgoing.params->id);
  ++count.sets;
  count.last_set = now;
  return outgoing;
}

}  // namespace trk_bridge::ros1
