// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "fixed_frame.h"

#include <cmath>

#include <rviz/frame_manager.h>
#include <tf2/exceptions.h>

#include "trk_bridge/ros/frames.h"

namespace trk_bridge::rviz_display {
namespace {

/// tf2 logs an error for each request with an invalid frame name.
bool is_valid_frame(const std::string& frame) { return !frame.empty() && frame.front() != '/'; }

}  // namespace

bool FixedFrame::knows(const std::string& frame, const ros::Time& time) const {
  const std::string& fixed = frames_.getFixedFrame();
  if (!is_valid_frame(frame) || !is_valid_frame(fixed)) return false;
  return frames_.getTF2BufferPtr()->tf2::BufferCore::canTransform(fixed, frame, time);
}

std::optional<Eigen::Isometry3d> FixedFrame::pose_of(const std::string& frame, const ros::Time& time) const {
  if (!knows(frame, time)) return std::nullopt;
  try {
    const auto transform =
        frames_.getTF2BufferPtr()->tf2::BufferCore::lookupTransform(frames_.getFixedFrame(), frame, time).transform;
    const auto& q = transform.rotation;
    const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    if (!(norm > 0)) return std::nullopt;
    const auto pose = ros1::to_isometry(transform);
    if (!pose.matrix().allFinite()) return std::nullopt;
    return pose;
  } catch (const tf2::TransformException&) {
    return std::nullopt;  // it expired since knows(); why_unknown() is called next
  }
}

std::string FixedFrame::why_unknown(const std::string& frame, const ros::Time& time) const {
  if (frame.empty()) return "the frame_id of CameraInfo is empty";
  if (!is_valid_frame(frame)) return "frame_id \"" + frame + "\" begins with a slash, which tf2 does not allow";
  if (!is_valid_frame(frames_.getFixedFrame())) {
    return "fixed frame \"" + frames_.getFixedFrame() + "\" is empty or begins with a slash, which tf2 does not allow";
  }
  std::string reason;
  if (frames_.transformHasProblems(frame, time, reason)) return reason;
  return "the transform of frame \"" + frame + "\" is invalid: its rotation or position is not finite";
}

}  // namespace trk_bridge::rviz_display
