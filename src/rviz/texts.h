// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Texts that are shown beside a camera.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <ros/time.h>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::rviz_display {

/// Values of a camera; unknown or unwanted values are none.
struct Values {
  std::optional<camera::PanTiltRoll> pan_tilt_roll;  ///< degrees
  std::optional<double> image_distance;              ///< mm
  std::optional<double> focal_length;                ///< pixels; shown if image_distance is not known
  struct Angles {
    double horizontal = 0, vertical = 0;
  };
  std::optional<Angles> field_of_view;  ///< degrees
  std::optional<std::uint64_t> counter;
};

/// At most two lines: the pose, and the lens with the counter. Empty if there are no values.
std::string text_of(const Values&);

/// The namespace of a topic: "returned" for "/returned/camera_info"; the topic if it has none.
std::string name_of_topic(const std::string& topic);

/// Seconds; an older camera is not live any more.
inline constexpr double old_age = 1;

/// The age of the drawn sample.
struct Age {
  bool fresh = true;  ///< neither older than old_age nor so far in the future
  std::string text;
};
/// With a zero stamp, the age is that of the arrival.
Age age_of(const ros::Time& stamp, const ros::Time& arrival, const ros::Time& now);

/// The text for a topic without new messages.
std::string silence_text(const std::string& topic, const ros::Time& last_arrival, const ros::Time& now);

}  // namespace trk_bridge::rviz_display
