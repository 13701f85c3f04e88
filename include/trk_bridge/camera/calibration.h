// The lens as ROS tells it: K and a fitted D (camera model, "CameraInfo").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

enum class DistortionModel : std::uint8_t { plumb_bob, rational_polynomial };

/// sensor_msgs' name of the model.
const char* name(DistortionModel) noexcept;

/// OpenCV's coefficients, undistorted to distorted, in its order: k1 k2 p1 p2 k3 [k4 k5 k6]. plumb_bob uses the first
/// five.
struct Distortion {
  DistortionModel model = DistortionModel::plumb_bob;
  std::array<double, 8> d{};
  double residual = 0;  ///< worst error over the image, pixels
};

/// Everything of a CameraInfo but its header. Row after row.
struct Calibration {
  std::uint32_t width = 0, height = 0;
  std::array<double, 9> k{};
  Distortion distortion;
};

/// Above this plumb_bob gives way to rational_polynomial (pixels).
inline constexpr double plumb_bob_tolerance = 0.01;

/// K for a lens and constants that have passed check().
[[nodiscard]] std::array<double, 9> camera_matrix(const Lens&, const wire::CameraConstants&) noexcept;

/// Fits D and keeps it as long as k1, k2, image distance and reach stay, so that a moving camera costs nothing. One a
/// camera; not synchronised. calibrate() allocates nothing.
class Calibrator {
 public:
  [[nodiscard]] Result<Calibration> calibrate(const Lens&, const wire::CameraConstants&) noexcept;

 private:
  struct Key {
    double k1 = 0, k2 = 0, image_distance = 0, reach = 0, pixels_per_mm = 0;
  };
  std::optional<Key> key_;
  Distortion fitted_;
};

/// What a CameraInfo says of a lens, in trk's terms.
struct FittedLens {
  Lens lens;  ///< focdist and aperture are 0: CameraInfo does not know them
  double residual = 0;  ///< worst error of the radial fit over the image, pixels
  double tangential = 0;  ///< worst displacement by p1, p2 over the image, pixels: lost, trk cannot tell it
};

/// The way back: K, D and the chip's size in `constants` (mm; blanks as they are to be sent) to k1, k2 in mm.
/// `d` has 0, 4, 5 or 8 coefficients.
[[nodiscard]] Result<FittedLens> lens_of(const std::array<double, 9>& k, const std::vector<double>& d,
                                         const wire::CameraConstants& constants);

}  // namespace trk_bridge::camera
