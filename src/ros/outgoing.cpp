#include "outgoing.h"

namespace trk_bridge::ros1 {

std::uint32_t sent_id(const OutgoingForm& form, std::uint32_t of_message, OutgoingStatistics& statistics) noexcept {
  const std::uint32_t wanted = form.id.value_or(of_message);
  if (!form.sends_id && wanted != 0) statistics.left_out_id = wanted;
  statistics.last_id = form.sends_id ? wanted : 0;
  return statistics.last_id;
}

void OutgoingConstants::use(const wire::CameraConstants& constants) noexcept {
  constants_ = camera::constants_for(constants, format_);
  constants_->id = 0;
}

std::optional<wire::CameraConstants> OutgoingConstants::news(std::uint32_t id) noexcept {
  if (!constants_) return std::nullopt;
  auto wanted = *constants_;
  wanted.id = id;
  if (told_ == wanted) return std::nullopt;
  told_ = wanted;
  return wanted;
}

}  // namespace trk_bridge::ros1
