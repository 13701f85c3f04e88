// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Publishes like a camera's node, but in the test, so that parts can be omitted or changed.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include "repeating.h"
#include "tracked_camera.h"

namespace trk_bridge::test {

/// A camera without distortion and blanks: /<name>/camera_info, /<name>/params and the transform studio to
/// <name>_optical with one stamp, at a rate, in a thread.
class PublishedCamera {
 public:
  /// Which messages are sent.
  struct Parts {
    bool camera_info = true, params = true, transform = true;
  };
  using Change = std::function<void(sensor_msgs::CameraInfo&)>;

  PublishedCamera(const std::string& name, const TrackedCamera& camera, double rate = 50);

  void is(const TrackedCamera& camera);
  void publishes(const Parts& parts);
  /// Applied to every CameraInfo before it is sent; none: unchanged.
  void spoils(const Change& change);

  const std::string& name() const { return name_; }
  std::string info_topic() const { return "/" + name_ + "/camera_info"; }
  std::string params_topic() const { return "/" + name_ + "/params"; }

 private:
  void publish();

  std::string name_;
  ::ros::Publisher infos_, params_, transforms_;
  std::mutex mutex_;
  TrackedCamera camera_;
  Parts parts_;
  Change change_;
  std::uint64_t counter_ = 0;
  // The last member: it must end before the others that it uses.
  std::unique_ptr<Repeating> publishing_;
};

/// The messages of one sample.
sensor_msgs::CameraInfo camera_info_of(const TrackedCamera& camera);
geometry_msgs::TransformStamped transform_of(const TrackedCamera& camera, const std::string& name);

}  // namespace trk_bridge::test
