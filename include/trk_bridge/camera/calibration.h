// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The lens as in CameraInfo: K and a fitted D (doc/lens_fit.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// The distortion models that are published in CameraInfo.
enum class DistortionModel : std::uint8_t { plumb_bob, rational_polynomial };

/// The name of the model in sensor_msgs.
const char* name(DistortionModel) noexcept;

/// The coefficients of OpenCV, undistorted to distorted, in its order: k1 k2 p1 p2 k3 [k4 k5 k6]. plumb_bob uses the
/// first five.
struct Distortion {
  DistortionModel model = DistortionModel::plumb_bob;
  std::array<double, 8> d{};
  double residual = 0;  ///< worst error over the image, pixels
};

/// All fields of a CameraInfo except its header. Matrices are row-major.
struct Calibration {
  std::uint32_t width = 0, height = 0;
  std::array<double, 9> k{};
  Distortion distortion;
};

/// The default tolerance in pixels: rational_polynomial is used if the error of plumb_bob is larger.
inline constexpr double plumb_bob_tolerance = 0.01;

/// K for a lens and for constants that passed check().
[[nodiscard]] std::array<double, 9> camera_matrix(const Lens&, const wire::CameraConstants&) noexcept;

/// Fits D and reuses the fit while k1, k2, the reach of the image and the pixel size do not change, so that a moving
/// camera needs no new fit. If only the image distance changes, D is scaled. One per camera; not synchronised. Nothing
/// here allocates.
class Calibrator {
 public:
  /// `tolerance`: the error in pixels up to which plumb_bob is used; infinite: always plumb_bob.
  explicit Calibrator(double tolerance = plumb_bob_tolerance) noexcept : tolerance_(tolerance) {}

  /// The fit is valid only up to the image corner that is farthest from the optical axis: clip points far outside of
  /// the image before you project them, because the distortion may fold there. If no model is within the tolerance, the
  /// best one is returned; its residual allows the caller to warn. Errors: bad_constants, bad_field_of_view (image
  /// distance), not_finite, not_monotonic (k1, k2 fold within the image) and no_fit.
  [[nodiscard]] Result<Calibration> calibrate(const Lens&, const wire::CameraConstants&) noexcept;

  /// Number of fits so far.
  std::uint64_t fits() const noexcept { return fits_; }

 private:
  struct Key {
    double k1 = 0, k2 = 0, reach = 0, pixels_per_mm = 0;
  };
  struct Fit {
    Key key;
    double undistorted_reach = 0;  // mm
    Distortion distortion;         // for an image distance of undistorted_reach
  };
  Result<Fit> fit(const Key&) const noexcept;

  double tolerance_;
  std::optional<Fit> fit_;
  std::uint64_t fits_ = 0;
};

/// The lens of a CameraInfo in the model of trk, and the errors of the conversion. Errors are the largest in the image,
/// in pixels.
struct FittedLens {
  Lens lens;              ///< focdist and aperture are 0: CameraInfo does not have them
  double residual = 0;    ///< error of the radial fit
  double tangential = 0;  ///< displacement by p1, p2, which is lost
  double aspect = 0;  ///< error of rows if fy does not match the image distance given by fx and the chip; fy is lost
};

/// The inverse: from K, D and the chip size in `constants` (mm; with the blanks that are sent) to k1, k2 in mm. The
/// image distance is computed from fx. `d` has 0, 4, 5 or 8 coefficients (4: plumb_bob without k3, 5: plumb_bob, 8:
/// rational_polynomial). Errors: bad_constants, bad_calibration, and not_monotonic if D, or the fitted k1 and k2, fold
/// within the image. Takes about 0.1 ms: reuse the result while K and D do not change.
[[nodiscard]] Result<FittedLens> fit_lens(const std::array<double, 9>& k, const std::vector<double>& d,
                                          const wire::CameraConstants& constants) noexcept;

/// r_u / r_d as a function of the distorted radius r (mm from the optical axis): (1 + n1 r^2 + n2 r^4 + n3 r^6) / (1 +
/// d1 r^2 + d2 r^4 + d3 r^6).
struct Undistortion {
  std::array<double, 3> numerator{}, denominator{};
};

/// The same for a lens that is known except for k1 and k2. Errors: bad_constants, bad_field_of_view (image distance),
/// and not_monotonic if the distortion, or the fitted k1 and k2, fold within the image.
[[nodiscard]] Result<FittedLens> fit_lens(const Lens& lens, const Undistortion& distortion,
                                          const wire::CameraConstants& constants) noexcept;

}  // namespace trk_bridge::camera
