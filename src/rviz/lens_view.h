// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The lens of a CameraInfo as it is drawn, computed again only when it changes.
#pragma once

#include <optional>
#include <string>

#include <sensor_msgs/CameraInfo.h>

#include "camera/figure.h"

namespace trk_bridge::rviz_display {

class LensView {
 public:
  /// Returns whether border() or fault() may have changed.
  bool update(const sensor_msgs::CameraInfo& info);

  /// Null if the lens is invalid.
  const camera::ImageBorder* border() const { return border_ ? &*border_ : nullptr; }
  /// Why it is invalid, for people; empty if it is valid.
  const std::string& fault() const { return fault_; }
  /// A description for people; empty if it is invalid.
  std::string text() const;
  /// fx in pixels; none if the lens is invalid.
  std::optional<double> focal_length() const;

  void forget() { *this = {}; }

 private:
  std::optional<camera::ViewingLens> lens_;
  std::optional<camera::ImageBorder> border_;
  std::string fault_;
};

}  // namespace trk_bridge::rviz_display
