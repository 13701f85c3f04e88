// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The parameters of trk_to_ros.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "bridge/camera_options.h"
#include "parameter_reader.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::ros1 {

/// The word for the sender's format.
inline constexpr const char* as_received = "as_received";
/// The mask of format words of the document; none for `as_received`.
tl::expected<std::optional<std::uint32_t>, std::string> parse_published_format(const std::string& words);

inline constexpr Range field_rate_range{1, 1000, "Hz"};
/// Of the delay that is subtracted from every stamp.
inline constexpr Range stamp_delay_range{0, 60, "seconds"};

/// Parameters of one camera.
struct CameraParameters {
  std::string name;                                 ///< of its topics, frames and diagnostics
  std::optional<transport::SourceEndpoint> source;  ///< required: always set after reading
  CameraFrames frames;                              ///< default: default_frames(name)
  std::optional<bridge::StampMode> stamp;           ///< as given; by default counter over a network, else arrival
  bridge::CameraOptions options;                    ///< its `stamp` is the one that is used
  bool publish_markers = false;                     ///< needs publish_camera_info
  double marker_far = 3;                            ///< m, length of frustum and axis of the markers
};

/// Parameters of the node, with their defaults.
struct TrkToRosParameters {
  std::vector<CameraParameters> cameras;  ///< at least one
  /// Whether `cameras` was given: then the topics of each camera are in a namespace with its name, else those of the
  /// only camera are in the namespace of the node.
  bool several = false;
  std::optional<double> field_rate;  ///< Hz; none: measured for counters, bridge::assumed_field_rate for files
  int queue_size = 100;              ///< messages
};

/// Reads the private parameters of a node. `camera_name` is the name of the only camera if `cameras` is not given.
/// Throws ParameterError with all faults.
TrkToRosParameters read_trk_to_ros_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
