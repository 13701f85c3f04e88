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

/// The word that leaves records in the sender's format.
inline constexpr const char* as_received = "as_received";
/// The mask that the document's words stand for; none for `as_received`.
tl::expected<std::optional<std::uint32_t>, std::string> parse_published_format(const std::string& words);

inline constexpr Range field_rate_range{1, 1000, "Hz"};
/// Of what is taken off every stamp.
inline constexpr Range stamp_delay_range{0, 60, "seconds"};

/// Parameters of one camera.
struct CameraParameters {
  std::string name;                                 ///< names its topics, frames and diagnostics
  std::optional<transport::SourceEndpoint> source;  ///< required: always there once read
  CameraFrames frames;                              ///< default: default_frames(name)
  std::optional<bridge::StampMode> stamp;           ///< as given; by default counter over a network, else arrival
  bridge::CameraOptions options;                    ///< its `stamp` is what counts
  bool publish_markers = false;                     ///< needs publish_camera_info
  double marker_far = 3;                            ///< m, where the markers' frustum and axis end
};

/// Parameters of the node, with their defaults.
struct TrkToRosParameters {
  std::vector<CameraParameters> cameras;  ///< at least one
  /// Whether `cameras` was given: then each one's topics are in a namespace of its name, else the only one's in the
  /// node's namespace itself.
  bool several = false;
  std::optional<double> field_rate;  ///< Hz; none: found for counters, bridge::assumed_field_rate for files
  int queue_size = 100;              ///< messages
};

/// Reads a node's private parameters. `camera_name` is the single camera's where no `cameras` are given. Throws
/// ParameterError with every fault.
TrkToRosParameters read_trk_to_ros_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
