// What trk_to_ros is told at its start.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trk_bridge/wire/record.h"

namespace XmlRpc {
class XmlRpcValue;
}

namespace trk_bridge::ros1 {

/// Parameters of one camera.
struct CameraParameters {
  std::string name;                 ///< names its topics, frames and diagnostics
  std::optional<std::uint32_t> id;  ///< none: whatever id comes; then its source must serve this camera alone
  std::string source;               ///< endpoint URL
  std::string studio_frame = "studio";
  std::string camera_frame;   ///< camera axes: x right, y forward, z up
  std::string optical_frame;  ///< static child of camera_frame
  /// The document's words for the format of published parameters, or `as_received`.
  std::string format = "euler";
  double delay = 0;                                ///< s, taken off every stamp, 0..60
  std::optional<wire::CameraConstants> constants;  ///< until the sender's own ones come
  bool publish_tf = true;
  bool publish_camera_info = true;
  bool publish_markers = false;  ///< needs publish_camera_info
  double marker_far = 3;         ///< m, where the markers' frustum and axis end, more than marker_near
};

/// The word that leaves records in the sender's format.
inline constexpr const char* as_received = "as_received";

/// Everything that trk_to_ros can be told, with its defaults.
struct TrkToRosParameters {
  /// At least one. Unless `several` was said, the only one's topics are in the node's namespace itself, else in one of
  /// its name below that.
  std::vector<CameraParameters> cameras;
  bool several = false;
  double field_rate = 50;  ///< Hz, 1..1000
  std::string stamp = "arrival";
  int queue_size = 100;  ///< messages, 1..100000
};

/// Seconds after which a camera that sends nothing new is silent: one, or five fields where these are longer.
inline double silence_after(double field_rate) { return std::max(1.0, 5.0 / field_rate); }

/// Every fault, a line each: the parameter, its value and what is allowed. Empty when all is well. Knows no ROS.
std::vector<std::string> validate(const TrkToRosParameters&);

/// Reads and validates a node's private parameters. `camera_name` is the single camera's where no `cameras` are given.
/// Throws ParameterError with every fault.
TrkToRosParameters read_trk_to_ros_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
