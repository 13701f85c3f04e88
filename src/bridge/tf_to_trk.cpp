// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tf_to_trk.h"

#include <algorithm>
#include <cmath>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge {

TfToTrk::TfToTrk(const TfToTrkOptions& options)
    : frame_T_camera_(options.frame_T_camera),
      chip_(options.chip),
      focdist_(options.focdist),
      aperture_(options.aperture),
      canonical_(wire::euler) {}

void TfToTrk::use(const CameraInfo& info, std::int64_t stamp, std::int64_t now) {
  ++statistics_.infos;
  statistics_.last_info = now;
  if (statistics_.infos == 1 || !same_calibration(info, calibration_)) fit(info);
  if (statistics_.info_is_refused) ++statistics_.refused_infos;
  auto& lens = lenses_[count_ % history];
  ++count_;
  lens.stamp = stamp;
  lens.lens = fitted_;
  if (!fitted_) return;
  lens.width = static_cast<std::int32_t>(info.width);
  lens.height = static_cast<std::int32_t>(info.height);
}

void TfToTrk::fit(const CameraInfo& info) {
  calibration_ = info;
  ++statistics_.fits;
  const auto fitted = fit_lens(info, chip_);
  statistics_.info_is_refused = !fitted;
  if (!fitted) {
    fitted_.reset();
    statistics_.info_fault = fitted.error();
    return;
  }
  fitted_ = fitted->lens;
  statistics_.residual = fitted->residual;
  statistics_.tangential = fitted->tangential;
  statistics_.aspect = fitted->aspect;
}

void TfToTrk::use_lens(double focdist, double aperture) noexcept {
  if (!std::isfinite(focdist) || !std::isfinite(aperture)) {
    ++statistics_.bad_lenses;
    return;
  }
  focdist_ = focdist;
  aperture_ = aperture;
}

void TfToTrk::restart() noexcept {
  last_pose_.reset();
  if (count_ == 0) return;
  lenses_[0] = newest();
  lenses_[0].stamp = 0;
  count_ = 1;
}

const TfToTrk::StampedLens& TfToTrk::newest(std::size_t back) const noexcept {
  return lenses_[(count_ - 1 - back) % history];
}

const TfToTrk::StampedLens& TfToTrk::lens_at(std::int64_t stamp) const noexcept {
  constexpr std::int64_t most_apart = 1'000'000'000;
  const std::size_t kept = std::min<std::uint64_t>(count_, history);
  if (stamp == 0 || newest().stamp - stamp > most_apart) return newest();
  for (std::size_t back = 0; back < kept; ++back) {
    if (newest(back).stamp <= stamp) return newest(back);
  }
  return newest(kept - 1);
}

bool TfToTrk::expects_lens(std::int64_t stamp) const noexcept {
  return in_step_ && stamp != 0 && (count_ == 0 || newest().stamp < stamp);
}

std::optional<OutgoingSet> TfToTrk::make(const Eigen::Isometry3d& studio_T_frame, std::int64_t stamp,
                                         std::int64_t now) {
  if (!has_lens()) return std::nullopt;
  const StampedLens& at = lens_at(stamp);
  in_step_ = at.stamp == stamp;
  if (!at.lens) return std::nullopt;
  camera::Camera camera{studio_T_frame * frame_T_camera_, *at.lens};
  camera.lens.focdist = focdist_;
  camera.lens.aperture = aperture_;
  const auto params = canonical_.convert(camera);
  // The pose is consumed, even if no set results.
  last_pose_ = stamp;
  if (!params) {
    ++statistics_.dropped;
    statistics_.drop_reason = params.error();
    return std::nullopt;
  }
  OutgoingSet set{std::nullopt, *params, stamp, at.stamp};
  set.params.counter = ++counter_;
  chip_.image_width = at.width;
  chip_.image_height = at.height;
  if (canonical_.use(chip_) == camera::ConstantsChange::changed) set.constants = chip_;
  statistics_.last_stamp = stamp;
  ++statistics_.sets;
  statistics_.last_set = now;
  return set;
}

}  // namespace trk_bridge::bridge
