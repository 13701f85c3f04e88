// The lens in the terms of ROS: K and a fitted D (doc/lens_fit.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::camera {

/// The models of CameraInfo that are published.
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

/// Above this plumb_bob gives way to rational_polynomial, unless asked otherwise (pixels).
inline constexpr double plumb_bob_tolerance = 0.01;

/// K for a lens and constants that have passed check().
[[nodiscard]] std::array<double, 9> camera_matrix(const Lens&, const wire::CameraConstants&) noexcept;

/// Fits D and keeps it as long as k1, k2, the reach of the image and the pixels' size stay, so that a moving camera
/// costs nothing; a change of image distance alone only scales it. One a camera; not synchronised. Nothing here
/// allocates.
class Calibrator {
 public:
  /// `tolerance`: the error in pixels up to which plumb_bob is used; infinite: plumb_bob always.
  explicit Calibrator(double tolerance = plumb_bob_tolerance) noexcept : tolerance_(tolerance) {}

  /// The fit covers the image to its farthest corner from the optical axis, no further: whoever projects points far
  /// outside of the image must clip first, since there the lens itself may fold. The best model within the
  /// constructor's tolerance is given however near it comes, with its residual, for the caller to warn of; errors are
  /// bad_constants, bad_field_of_view (image distance), not_finite, not_monotonic (k1, k2 fold within the image) and
  /// no_fit.
  [[nodiscard]] Result<Calibration> calibrate(const Lens&, const wire::CameraConstants&) noexcept;

  /// How many fits were made so far.
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

/// What a CameraInfo says of a lens, in trk's terms, and what trk has no terms for. Worst over the image, in pixels.
struct FittedLens {
  Lens lens;              ///< focdist and aperture are 0: CameraInfo does not know them
  double residual = 0;    ///< error of the radial fit
  double tangential = 0;  ///< displacement by p1, p2: lost
  double aspect = 0;      ///< error of rows where fy does not agree with the image distance of fx and the chip: lost
};

/// The way back: K, D and the chip's size in `constants` (mm; blanks as they are to be sent) to k1, k2 in mm. The image
/// distance is that of fx. `d` has 0, 4, 5 or 8 coefficients (plumb_bob without k3, plumb_bob, rational_polynomial).
/// Errors are bad_constants, bad_calibration, and not_monotonic where D, or k1 and k2 fitted to it, fold within the
/// image. Takes about a tenth of a millisecond: keep the result while K and D stay.
[[nodiscard]] Result<FittedLens> fit_lens(const std::array<double, 9>& k, const std::vector<double>& d,
                                          const wire::CameraConstants& constants) noexcept;

/// r_u / r_d as a function of the distorted radius r (mm about the optical axis): (1 + n1 r^2 + n2 r^4 + n3 r^6) / (1 +
/// d1 r^2 + d2 r^4 + d3 r^6).
struct Undistortion {
  std::array<double, 3> numerator{}, denominator{};
};

/// Likewise, for a lens of which all but k1 and k2 is known. Errors are bad_constants, bad_field_of_view (image
/// distance), and not_monotonic where the distortion, or k1 and k2 fitted to it, fold within the image.
[[nodiscard]] Result<FittedLens> fit_lens(const Lens& lens, const Undistortion& distortion,
                                          const wire::CameraConstants& constants) noexcept;

}  // namespace trk_bridge::camera
