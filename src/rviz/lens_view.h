// A CameraInfo's lens as it is drawn, computed again only when it changes.
#pragma once

#include <optional>
#include <string>

#include <sensor_msgs/CameraInfo.h>

#include "camera/figure.h"

namespace trk_bridge::rviz_display {

class LensView {
 public:
  /// Whether border() or fault() may be others than before.
  bool look_through(const sensor_msgs::CameraInfo& info);

  /// Null where the lens is none.
  const camera::ImageBorder* border() const { return border_ ? &*border_ : nullptr; }
  /// Why it is none, for a person; empty where it is one.
  const std::string& fault() const { return fault_; }
  /// What it is, for a person; empty where it is none.
  std::string text() const;
  /// fx in pixels; nothing where the lens is none.
  std::optional<double> focal_length() const;

  void forget() { *this = {}; }

 private:
  std::optional<camera::ViewingLens> lens_;
  std::optional<camera::ImageBorder> border_;
  std::string fault_;
};

}  // namespace trk_bridge::rviz_display
