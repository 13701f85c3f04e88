// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A camera that `trk detect` has found: its sender, whether its values are plausible, and how to use it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "monitor/model.h"

namespace trk_bridge::tools {

/// The range of a camera's motion.
class Motion {
 public:
  struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;

    double size() const noexcept { return most - least; }
  };

  /// studio_T_camera, m.
  void add(const Eigen::Isometry3d& pose);

  Range x, y, z;          ///< m
  Range pan, tilt, roll;  ///< degrees; pan and roll continue beyond 180

 private:
  double last_pan_ = 0, last_roll_ = 0;
};

/// One camera of one sender.
struct Detected {
  std::string protocol;         ///< "Free-D"
  std::string place;            ///< where it arrived: "udp port 7000 on every interface"
  std::string source;           ///< the URL of a source that receives it
  bool needs_id = false;        ///< others arrive at the same place
  bool is_shared = false;       ///< another sender has the same id there
  std::string other_options;    ///< options of a URL that accepts records which `source` refuses; empty: none
  monitor::CameraState camera;  ///< with `latest`
  Motion motion;
};

/// What is not plausible for a camera in a studio, one sentence each; empty if everything is plausible.
std::vector<std::string> doubts_of(const Detected&);

/// The command that publishes the camera in ROS.
std::string launch_line(const Detected&);

/// Text for people.
std::vector<std::string> lines_of(const Detected&);
/// A JSON object.
std::string json_of(const Detected&);

}  // namespace trk_bridge::tools
