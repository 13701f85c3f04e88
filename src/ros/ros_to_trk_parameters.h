// What ros_to_trk is told at its start.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trk_bridge/wire/record.h"

namespace XmlRpc {
class XmlRpcValue;
}

namespace trk_bridge::ros1 {

/// Everything that ros_to_trk can be told, with its defaults.
struct RosToTrkParameters {
  std::string name;                ///< the camera's: names its diagnostics
  std::vector<std::string> sinks;  ///< endpoint URLs, at least one; each is written
  std::string input = "params";    ///< `params` or `tf`
  /// One of both: the document's words, or a receiver's name. Neither: euler.
  std::optional<std::string> format, preset;
  /// Sent with every record. None: with `params` the messages' own, with `tf` 0.
  std::optional<std::uint32_t> id;
  int queue_size = 100;  ///< messages that wait for the node, 1..100000

  // input: params
  std::optional<wire::CameraConstants> constants;  ///< until some are received

  // input: tf
  double rate = 50;                               ///< Hz, 1..1000
  std::optional<double> chip_width, chip_height;  ///< mm, both needed
  /// Pixels of the image that the chip does not fill.
  std::int32_t blank_left = 0, blank_right = 0, blank_top = 0, blank_bottom = 0;
  std::string studio_frame = "studio";
  std::string camera_frame;              ///< camera axes, or with the next optical ones
  bool camera_frame_is_optical = false;  ///< x right, y down, z forward (REP 103) instead of x right, y forward, z up
  double focdist = 0;                    ///< m, until the `lens` topic tells it
  double aperture = 0;                   ///< f-stop, likewise
};

/// How records have to be told.
struct OutgoingForm {
  std::uint32_t format = 0;         ///< FormatBit mask that a record may be made in
  bool sends_id = true;             ///< false: the receiver can take none, and 0 is sent
  std::optional<std::uint32_t> id;  ///< instead of what messages say
};

/// Every fault, a line each: the parameter, its value and what is allowed. Empty when all is well. Knows no ROS.
std::vector<std::string> validate(const RosToTrkParameters&);

/// What `format`, `preset` and `id` say. They must have passed validate().
OutgoingForm form_of(const RosToTrkParameters&);

/// Reads and validates a node's private parameters; `camera_name` names the camera, and its frame where none is given.
/// Throws ParameterError with every fault.
RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
