// The camera that looks at the test card: the document's own way from the studio to pixels, lens and all.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "test_card_figure.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/camera/image.h"

namespace trk_bridge::demo {

/// A straight line of a Line as the lens bends it, pixels in ROS coordinates (origin in the centre of the top left one,
/// y down). Empty where the camera does not see it.
using Polyline = std::vector<Eigen::Vector2d>;

/// How far a Polyline may lie beside the curve that it stands for, pixels.
inline constexpr double chord_tolerance = 0.01;

/// Whether and where points and lines of the studio (m) are seen. What is beyond the radius where k1, k2 fold the image
/// is not seen.
class View {
 public:
  /// Errors are those of camera::decode.
  static camera::Result<View> of(const wire::CameraParams&, const wire::CameraConstants&);

  std::optional<Eigen::Vector2d> see(const Eigen::Vector3d& point) const;
  /// Into `seen`, which is emptied before.
  void see(const Line& line, Polyline& seen) const;

  int width() const { return static_cast<int>(raster_.width); }
  int height() const { return static_cast<int>(raster_.height); }

 private:
  View(const camera::Camera&, const camera::Raster&);
  bool within_lens(const Eigen::Vector2d& undistorted) const;
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector2d& undistorted) const;
  void bend(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Polyline& seen) const;

  Eigen::Isometry3d camera_T_studio_;
  camera::Lens lens_;
  camera::Raster raster_;
  // mm about the optical axis: what is farther is not in the image, or is beyond the fold.
  double undistorted_reach_ = 0;
};

}  // namespace trk_bridge::demo
