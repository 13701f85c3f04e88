// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts the records of one camera to one format and stores its constants (doc/conventions.md).
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::camera {

/// The effect of constants on a Converter.
enum class ConstantsChange : std::uint8_t {
  unchanged,  ///< equal to the previous ones in every field, including the id
  changed,    ///< the first ones, or different ones: they are used from now on
  invalid,    ///< they do not pass check(): the previous ones are kept
};

/// One set of parameters, decoded and converted. Each part can fail independently.
struct Converted {
  Result<Eigen::Isometry3d> pose;     ///< studio_T_camera, metres: decode_pose
  Result<Lens> lens;                  ///< decode_lens: constants_needed if the format needs them and there are none
  Result<wire::CameraParams> params;  ///< in the format of the converter; id and counter unchanged
};

/// Why a record does not describe a camera in any format: a pose that is not finite or not a rotation, or a lens that
/// is not finite. Without `has_lens` the lens is not checked. None for a valid camera.
[[nodiscard]] std::optional<CameraReason> why_not_a_camera(const Converted&, bool has_lens = true) noexcept;

/// Converts the records of one camera to one format and stores its constants. Not synchronised, never allocates.
class Converter {
 public:
  /// `format` is a FormatBit mask that passes wire::is_writable; with any other, convert() fails with bad_format.
  /// Without a format, records are not changed.
  explicit Converter(std::optional<std::uint32_t> format = std::nullopt) noexcept : format_(format) {}

  std::optional<std::uint32_t> format() const noexcept { return format_; }

  /// Sets the constants of the camera. A caller that must not use older ones when the new ones are invalid calls
  /// forget().
  [[nodiscard]] ConstantsChange use(const wire::CameraConstants&) noexcept;
  /// Removes the constants.
  void forget() noexcept { constants_.reset(); }

  /// The constants as received; null if none are known.
  const wire::CameraConstants* incoming() const noexcept { return constants_ ? &constants_->incoming : nullptr; }
  /// The constants to send with converted parameters: the fake chip matches the format (constants_for), the id is
  /// unchanged. Null if none are known.
  const wire::CameraConstants* outgoing() const noexcept { return constants_ ? &constants_->outgoing : nullptr; }

  /// Decodes and converts. Pose, fov and centre shift each keep exactly the same doubles, whatever they are, if their
  /// own options do not change (keep_aspect, for example, matters only for values that use the fake chip) and if the
  /// outgoing constants give them the same meaning as the incoming ones. k1, k2, focdist and aperture are always kept.
  /// From Euler to Euler the angles are kept as well. A part that changes must be decodable, or there are no
  /// parameters.
  [[nodiscard]] Converted convert(const wire::CameraParams&) const noexcept;

  /// A canonical camera in the format, or in `euler` without other options if there is no format; id 0 and counter 0.
  [[nodiscard]] Result<wire::CameraParams> convert(const Camera&) const noexcept;

 private:
  struct Constants {
    wire::CameraConstants incoming, outgoing;
  };

  std::optional<std::uint32_t> format_;
  std::optional<Constants> constants_;
};

}  // namespace trk_bridge::camera
