// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_status.h"

#include "base/number_text.h"
#include "texts.h"

namespace trk_bridge::rviz_display {
namespace {

std::string metres(double value) { return base::general_text(value) + " m"; }

}  // namespace

void CameraStatus::begin(const ros::Time& now, double steady) {
  now_ = now;
  steady_ = steady;
}

void CameraStatus::set(StatusLevel level, const std::string& name, const std::string& text) {
  lines_.set(level, name, text, steady_);
}

bool CameraStatus::topic(const std::string& name, const TopicState& state) {
  if (!state.fault.empty()) {
    set(StatusLevel::error, name, state.fault);
  } else if (state.received == 0) {
    set(StatusLevel::warn, name, "no messages received on " + state.topic);
  } else if (!state.alive) {
    set(StatusLevel::warn, name, silence_text(state.topic, state.last_arrival, now_));
  } else {
    return true;
  }
  return false;
}

void CameraStatus::camera_info(const TopicState& state) {
  if (state.topic.empty() && state.fault.empty()) {
    set(StatusLevel::warn, "Camera Info", "no topic selected");
  } else if (topic("Camera Info", state)) {
    set(StatusLevel::ok, "Camera Info", std::to_string(state.received) + " messages received");
  }
}

void CameraStatus::camera_params(const TopicState& state, const std::string& pose_fault) {
  if (state.topic.empty() && state.fault.empty()) {
    lines_.remove("Camera Params");
  } else if (topic("Camera Params", state)) {
    if (pose_fault.empty()) {
      set(StatusLevel::ok, "Camera Params", std::to_string(state.received) + " messages received");
    } else {
      set(StatusLevel::warn, "Camera Params", "no valid pose, that of tf is shown: " + pose_fault);
    }
  }
}

void CameraStatus::constants(const TopicState& info, const TopicState& params) {
  if (info.received > 0 && !params.topic.empty()) {
    set(StatusLevel::ok, "Constants", "known");
  } else if (params.alive && info.received == 0 && !info.topic.empty()) {
    set(StatusLevel::warn, "Constants",
        "unknown: CameraParams are received, but no CameraInfo; trk_to_ros publishes none until constants of the "
        "camera are received or set");
  } else {
    lines_.remove("Constants");
  }
}

void CameraStatus::transform(const std::string& why_missing) {
  if (why_missing.empty()) {
    set(StatusLevel::ok, "Transform", "known");
  } else {
    set(StatusLevel::error, "Transform", why_missing);
  }
}

void CameraStatus::lens(const LensView& lens) {
  if (lens.border() != nullptr) {
    set(StatusLevel::ok, "Lens", lens.text());
  } else {
    set(StatusLevel::error, "Lens", lens.fault());
  }
}

void CameraStatus::frustum(bool on, double near, double far) {
  if (!on || near < far) {
    lines_.remove("Frustum");
  } else {
    set(StatusLevel::error, "Frustum",
        "not drawn: Near (" + metres(near) + ") must be less than Far (" + metres(far) + ")");
  }
}

void CameraStatus::focus_plane(double distance) {
  if (camera::draws_focus(distance)) {
    set(StatusLevel::ok, "Focus Plane", metres(distance));
  } else {
    set(StatusLevel::ok, "Focus Plane",
        "not drawn: focdist is " + metres(distance) + ", drawn is more than 0 up to " + metres(camera::farthest_focus));
  }
}

void CameraStatus::age(const ros::Time& stamp, const ros::Time& arrival) {
  const auto age = age_of(stamp, arrival, now_);
  set(age.fresh ? StatusLevel::ok : StatusLevel::warn, "Age", age.text);
}

void CameraStatus::nothing_drawn(bool transform_missing) {
  if (!transform_missing) lines_.remove("Transform");
  for (const char* name : {"Lens", "Frustum", "Focus Plane"}) lines_.remove(name);
}

}  // namespace trk_bridge::rviz_display
