// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/converter.h"

#include "params.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::camera {
namespace {

Result<wire::CameraParams> in_format(std::uint32_t format, const wire::CameraParams& params,
                                     const Result<Eigen::Isometry3d>& pose, const LensParts& lens,
                                     const wire::CameraConstants* outgoing) noexcept {
  if (!wire::is_writable(format)) return tl::unexpected(CameraReason::bad_format);
  wire::CameraParams out;
  out.id = params.id;
  out.counter = params.counter;
  out.format = format;
  if (const auto done = convert_pose(params, pose, out); !done) return tl::unexpected(done.error());
  if (const auto done = convert_lens(params, lens, outgoing, out); !done) return tl::unexpected(done.error());
  return out;
}

}  // namespace

std::optional<CameraReason> why_not_a_camera(const Converted& converted, bool has_lens) noexcept {
  if (!converted.pose) return converted.pose.error();
  if (has_lens && !converted.lens && converted.lens.error() == CameraReason::not_finite) return converted.lens.error();
  return std::nullopt;
}

ConstantsChange Converter::use(const wire::CameraConstants& constants) noexcept {
  if (!check(constants)) return ConstantsChange::invalid;
  if (constants_ && constants_->incoming == constants) return ConstantsChange::unchanged;
  constants_ = Constants{constants, format_ ? constants_for(constants, *format_) : constants};
  return ConstantsChange::changed;
}

Converted Converter::convert(const wire::CameraParams& params) const noexcept {
  const LensParts lens = lens_parts(params, incoming());
  Converted converted{decode_pose(params), decode_lens(params, lens), params};
  if (format_) converted.params = in_format(*format_, params, converted.pose, lens, outgoing());
  return converted;
}

Result<wire::CameraParams> Converter::convert(const Camera& camera) const noexcept {
  return encode(camera, format_.value_or(wire::euler), outgoing());
}

}  // namespace trk_bridge::camera
