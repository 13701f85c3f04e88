// The status lines of a camera's display.
#pragma once

#include <cstdint>
#include <string>

#include <ros/time.h>

#include "lens_view.h"
#include "status_lines.h"

namespace trk_bridge::rviz_display {

/// What a topic's line shows.
struct TopicState {
  std::string topic;  ///< empty: none is chosen
  std::string fault;  ///< why it could not be subscribed to; empty: it was
  std::uint64_t received = 0;
  ros::Time last_arrival;
  bool alive = false;  ///< messages still come
};

/// Every function is to be called once a rendered frame while its line is to be seen. For one thread.
class CameraStatus {
 public:
  CameraStatus(StatusLines::Show show, StatusLines::Remove remove) : lines_(std::move(show), std::move(remove)) {}

  /// The display's clear of all lines has been or will be called.
  void forget() { lines_.forget(); }
  /// `now` in ROS time, `steady` in seconds, of the calls that follow.
  void begin(const ros::Time& now, double steady);

  void camera_info(const TopicState&);
  /// `pose_fault`: why the pose of the parameters in use is none.
  void camera_params(const TopicState&, const std::string& pose_fault);
  void constants(const TopicState& info, const TopicState& params);
  /// An empty reason: there is a transform.
  void transform(const std::string& why_missing);
  void lens(const LensView&);
  /// A frustum between these depths, m.
  void frustum(bool on, double near, double far);
  /// `distance` is focdist in m.
  void focus_plane(double distance);
  void no_focus_plane() { lines_.remove("Focus Plane"); }
  /// Of the CameraInfo that is drawn, or of the newest where none is.
  void age(const ros::Time& stamp, const ros::Time& arrival);

  /// Nothing is drawn: no line about what is. The transform's stays where it is the reason, the age's always.
  void nothing_drawn(bool transform_missing);

 private:
  bool topic(const std::string& name, const TopicState&);
  void set(StatusLevel level, const std::string& name, const std::string& text);

  StatusLines lines_;
  ros::Time now_;
  double steady_ = 0;
};

}  // namespace trk_bridge::rviz_display
