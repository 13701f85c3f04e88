// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "lens_view.h"

#include "base/number_text.h"
#include "ros/camera_info.h"

namespace trk_bridge::rviz_display {
namespace {

std::string numbers(const camera::ViewingLens& lens) {
  return "fx " + base::general_text(lens.k[0]) + ", fy " + base::general_text(lens.k[4]) + ", image " +
         std::to_string(lens.width) + " x " + std::to_string(lens.height);
}

}  // namespace

bool LensView::update(const sensor_msgs::CameraInfo& info) {
  auto lens = bridge::viewing_lens(ros1::from_msg(info));
  if (!lens) {
    std::string fault = bridge::describe(lens.error());
    if (!lens_ && fault == fault_) return false;
    forget();
    fault_ = std::move(fault);
    return true;
  }
  if (lens_ && *lens_ == *lens) return false;
  forget();
  lens_ = std::move(*lens);
  if (const auto border = camera::image_border(*lens_)) {
    border_ = *border;
  } else {
    fault_ = camera::describe(border.error()) + " (" + numbers(*lens_) + ")";
  }
  return true;
}

std::string LensView::text() const { return border_ ? numbers(*lens_) : std::string(); }

std::optional<double> LensView::focal_length() const {
  if (!border_) return std::nullopt;
  return lens_->k[0];
}

}  // namespace trk_bridge::rviz_display
