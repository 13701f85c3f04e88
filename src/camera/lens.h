// Lens parameters as a format tells them: field of view and centre shift against the constants.
#pragma once

#include <cstdint>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// Writes fov, centre shift, k1, k2, focdist and aperture of `params` as `params.format` says.
[[nodiscard]] Result<void> encode_lens(const Lens&, const wire::CameraConstants* constants,
                                       wire::CameraParams& params) noexcept;

/// The lens of `params` as `told.format` says, into `told`. Field of view and centre shift each keep their very doubles
/// where neither the options nor the constants they depend on differ.
[[nodiscard]] Result<void> reexpress_lens(const wire::CameraParams& params, const wire::CameraConstants* incoming,
                                          const wire::CameraConstants* outgoing, wire::CameraParams& told) noexcept;

}  // namespace trk_bridge::camera
