// Records of one camera to one format, with the camera's constants remembered (doc/conventions.md).
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "trk_bridge/camera/camera.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::camera {

/// What became of constants that were given to a Converter.
enum class ConstantsChange : std::uint8_t {
  unchanged,  ///< equal to those before in every field, the id as well
  changed,    ///< the first ones, or they differ: they are used from now on
  invalid,    ///< they do not pass check(): they are not used, and those before stay
};

/// One set of parameters, decoded and converted. Each part stands by itself: any of them can fail alone.
struct Converted {
  Result<Eigen::Isometry3d> pose;     ///< studio_T_camera, metres: decode_pose
  Result<Lens> lens;                  ///< decode_lens: constants_needed where the format needs them and there are none
  Result<wire::CameraParams> params;  ///< in the converter's format; id and counter as they came
};

/// Why a record is no camera, whatever the format: a pose that is not finite or no rotation, or a lens that is not
/// finite. Without `has_lens` the lens says nothing. None where it is one.
[[nodiscard]] std::optional<CameraReason> why_not_a_camera(const Converted&, bool has_lens = true) noexcept;

/// Converts one camera's records to one format and remembers the camera's constants. Not synchronised, never allocates.
class Converter {
 public:
  /// `format` is a FormatBit mask that passes wire::is_writable (with any other, convert() makes no parameters:
  /// bad_format). Without one, records stay as they are.
  explicit Converter(std::optional<std::uint32_t> format = std::nullopt) noexcept : format_(format) {}

  std::optional<std::uint32_t> format() const noexcept { return format_; }

  /// Constants of the camera that the parameters come from. Whoever must not use older ones where the new ones are
  /// unsound calls forget().
  [[nodiscard]] ConstantsChange use(const wire::CameraConstants&) noexcept;
  /// Back to no constants.
  void forget() noexcept { constants_.reset(); }

  /// The constants as they came; null where none are known.
  const wire::CameraConstants* incoming() const noexcept { return constants_ ? &constants_->incoming : nullptr; }
  /// Those to send with converted parameters: the fake chip agrees with the format (constants_for); the id as it came.
  /// Null where none are known.
  const wire::CameraConstants* outgoing() const noexcept { return constants_ ? &constants_->outgoing : nullptr; }

  /// Decodes and converts. Each of pose, fov and centre shift whose own options do not change (keep_aspect, say, only
  /// concerns what is in terms of the fake chip) keeps the very doubles it came with, whatever they are, unless the
  /// outgoing constants give it another meaning than the incoming ones; k1, k2, focdist and aperture always do. From
  /// Euler to Euler the angles stay as well. What changes must be decodable, or there are no parameters.
  [[nodiscard]] Converted convert(const wire::CameraParams&) const noexcept;

  /// A canonical camera in the format, or in euler and nothing else where there is none; id 0 and counter 0.
  [[nodiscard]] Result<wire::CameraParams> convert(const Camera&) const noexcept;

 private:
  struct Constants {
    wire::CameraConstants incoming, outgoing;
  };

  std::optional<std::uint32_t> format_;
  std::optional<Constants> constants_;
};

}  // namespace trk_bridge::camera
