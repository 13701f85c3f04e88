// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_info.h"

#include <limits>
#include <optional>

namespace trk_bridge::bridge {
namespace {

using camera::DistortionModel;

std::optional<InfoReason> fault_of_size(const CameraInfo& info) noexcept {
  constexpr std::uint32_t largest = std::numeric_limits<std::int32_t>::max();
  if (info.width == 0 || info.height == 0 || info.width > largest || info.height > largest) return InfoReason::no_size;
  return std::nullopt;
}

std::optional<InfoReason> fault_of_model(const CameraInfo& info) noexcept {
  const std::size_t count = info.d.size();
  if (info.distortion_model.empty() && count == 0) return std::nullopt;
  if (info.distortion_model == camera::name(DistortionModel::plumb_bob)) {
    if (count == 0 || count == 4 || count == 5) return std::nullopt;
    return InfoReason::coefficients;
  }
  if (info.distortion_model == camera::name(DistortionModel::rational_polynomial)) {
    if (count == 8) return std::nullopt;
    return InfoReason::coefficients;
  }
  return InfoReason::unknown_model;
}

std::optional<InfoReason> fault_of(const CameraInfo& info) noexcept {
  const auto fault = fault_of_size(info);
  return fault ? fault : fault_of_model(info);
}

}  // namespace

std::string describe(const InfoFault& fault) {
  switch (fault.reason) {
    case InfoReason::no_size:
      return "width and height must be from 1 to 2147483647";
    case InfoReason::unknown_model:
      return "distortion_model must be plumb_bob or rational_polynomial";
    case InfoReason::coefficients:
      return "D must have 0, 4 or 5 coefficients with plumb_bob, 8 with rational_polynomial";
    case InfoReason::no_lens:
      return camera::describe(fault.camera);
  }
  return "unknown reason";
}

tl::expected<camera::FittedLens, InfoFault> fit_lens(const CameraInfo& info,
                                                     const wire::CameraConstants& chip) noexcept {
  if (const auto reason = fault_of(info)) return tl::unexpected(InfoFault{*reason, {}});
  auto constants = chip;
  constants.image_width = static_cast<std::int32_t>(info.width);
  constants.image_height = static_cast<std::int32_t>(info.height);
  const auto lens = camera::fit_lens(info.k, info.d, constants);
  if (!lens) return tl::unexpected(InfoFault{InfoReason::no_lens, lens.error()});
  return *lens;
}

tl::expected<camera::ViewingLens, InfoFault> viewing_lens(const CameraInfo& info) {
  if (const auto reason = fault_of(info)) return tl::unexpected(InfoFault{*reason, {}});
  return camera::ViewingLens{info.k, info.d, info.width, info.height};
}

bool same_calibration(const CameraInfo& a, const CameraInfo& b) noexcept {
  return a.width == b.width && a.height == b.height && a.k == b.k && a.d == b.d &&
         a.distortion_model == b.distortion_model;
}

}  // namespace trk_bridge::bridge
