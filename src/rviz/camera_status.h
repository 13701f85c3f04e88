// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The status lines of the display.
#pragma once

#include <cstdint>
#include <string>

#include <ros/time.h>

#include "lens_view.h"
#include "status_lines.h"

namespace trk_bridge::rviz_display {

/// The state of a topic.
struct TopicState {
  std::string topic;  ///< empty: none selected
  std::string fault;  ///< why subscribing failed; empty: it did not
  std::uint64_t received = 0;
  ros::Time last_arrival;
  bool alive = false;  ///< messages are received
};

/// Call each function once per rendered frame as long as its line should be visible. For one thread.
class CameraStatus {
 public:
  CameraStatus(StatusLines::Show show, StatusLines::Remove remove) : lines_(std::move(show), std::move(remove)) {}

  /// Call when the display clears all lines.
  void forget() { lines_.forget(); }
  /// Sets the time for the following calls: `now` in ROS time, `steady` in seconds.
  void begin(const ros::Time& now, double steady);

  void camera_info(const TopicState&);
  /// `pose_fault`: why the parameters have no valid pose.
  void camera_params(const TopicState&, const std::string& pose_fault);
  void constants(const TopicState& info, const TopicState& params);
  /// Empty: there is a transform.
  void transform(const std::string& why_missing);
  void lens(const LensView&);
  /// A frustum between these depths, m.
  void frustum(bool on, double near, double far);
  /// `distance` is focdist in m.
  void focus_plane(double distance);
  void no_focus_plane() { lines_.remove("Focus Plane"); }
  /// Of the CameraInfo that is drawn, or of the newest if none is drawn.
  void age(const ros::Time& stamp, const ros::Time& arrival);

  /// Nothing is drawn: removes the lines about drawn parts. Keeps that of the transform if it is the reason, and always
  /// that of the age.
  void nothing_drawn(bool transform_missing);

 private:
  bool topic(const std::string& name, const TopicState&);
  void set(StatusLevel level, const std::string& name, const std::string& text);

  StatusLines lines_;
  ros::Time now_;
  double steady_ = 0;
};

}  // namespace trk_bridge::rviz_display
