// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_history.h"

namespace trk_bridge::bridge {
namespace {

bool is_same(const camera::Lens& a, const camera::Lens& b) noexcept {
  return a.image_distance == b.image_distance && a.center_shift == b.center_shift && a.k1 == b.k1 && a.k2 == b.k2 &&
         a.focdist == b.focdist && a.aperture == b.aperture;
}

}  // namespace

void CameraHistory::add(const camera::Camera& camera, std::int64_t time, std::int64_t lens_time) noexcept {
  poses_.add(time, camera.pose);
  lens_has_own_times_ = lens_time != time;
  if (lens_has_own_times_ && !lenses_.is_empty() && lens_time <= lenses_.newest().time) {
    if (is_same(lenses_.newest().value, camera.lens)) return;
    lens_time = time;
  }
  lenses_.add(lens_time, camera.lens);
}

std::optional<CameraHistory::Found> CameraHistory::at(const PartTimes& wanted, std::int64_t lead) const noexcept {
  if (is_empty() || std::min(wanted.position, wanted.rotation) < poses_.oldest().time) return std::nullopt;
  const auto position = poses_.place_of(wanted.position, lead);
  const auto rotation = poses_.place_of(wanted.rotation, lead);
  const auto lens = lenses_.place_of(wanted.lens, lead);
  Found found;
  found.camera.pose.translation() = camera::interpolate(position.before->value.translation().eval(),
                                                        position.after->value.translation().eval(), position.part);
  found.camera.pose.linear() =
      camera::interpolate(rotation.before->value.linear().eval(), rotation.after->value.linear().eval(), rotation.part);
  found.camera.lens = camera::interpolate(lens.before->value, lens.after->value, lens.part);
  found.times = {position.time, rotation.time, lens.time};
  // A lens with separate stamps may simply not have changed: it need not be newer than the pose.
  const std::int64_t newest_lens = lens_has_own_times_ ? newest() : lenses_.newest().time;
  found.margins = {newest() - wanted.position, newest() - wanted.rotation, newest_lens - wanted.lens};
  return found;
}

}  // namespace trk_bridge::bridge
