// What is written beside a camera and about it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <ros/time.h>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::rviz_display {

/// What there is to say of a camera; what is not known, or not wanted, is left out.
struct Values {
  std::optional<camera::PanTiltRoll> pan_tilt_roll;  ///< degrees
  std::optional<double> image_distance;              ///< mm
  std::optional<double> focal_length;                ///< pixels; shown where image_distance is not known
  struct Angles {
    double horizontal = 0, vertical = 0;
  };
  std::optional<Angles> field_of_view;  ///< degrees
  std::optional<std::uint64_t> counter;
};

/// Two lines at most: the pose, and the lens with the counter. Empty when there is nothing to say.
std::string text_of(const Values&);

/// The namespace of a topic, "returned" of "/returned/camera_info"; the topic where it has none.
std::string name_of_topic(const std::string& topic);

/// Beyond this a camera is not live any more, seconds.
inline constexpr double old_age = 1;

/// How old the drawn sample is.
struct Age {
  bool fresh = true;  ///< neither older than old_age nor as far in the future
  std::string text;
};
/// A zero stamp has no age but that of its arrival.
Age age_of(const ros::Time& stamp, const ros::Time& arrival, const ros::Time& now);

/// Of a topic that nothing comes of any more.
std::string silence_text(const std::string& topic, const ros::Time& last_arrival, const ros::Time& now);

}  // namespace trk_bridge::rviz_display
