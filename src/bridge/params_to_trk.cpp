// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "params_to_trk.h"

namespace trk_bridge::bridge {

ParamsToTrk::ParamsToTrk(const std::optional<wire::CameraConstants>& constants) noexcept : newest_(constants) {
  if (constants) statistics_.constants = ConstantsOrigin::parameter;
}

void ParamsToTrk::use(const wire::CameraConstants& constants) noexcept {
  if (!camera::check(constants)) {
    ++statistics_.bad_constants;
    return;
  }
  newest_ = constants;
  statistics_.constants = ConstantsOrigin::own;
}

OutgoingSet ParamsToTrk::use(const wire::CameraParams& params, std::int64_t now) noexcept {
  ++statistics_.received;
  statistics_.last_received = now;
  statistics_.last_format = params.format;
  OutgoingSet set{std::nullopt, params, 0, 0};
  if (!newest_) return set;
  newest_->id = params.id;
  if (given_.use(*newest_) == camera::ConstantsChange::changed) set.constants = newest_;
  return set;
}

}  // namespace trk_bridge::bridge
