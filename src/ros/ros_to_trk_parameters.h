// The parameters of ros_to_trk.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bridge/tf_to_trk.h"
#include "parameter_reader.h"
#include "trk_bridge/transport/endpoint.h"
#include "trk_bridge/wire/format.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// How long before a camera may be sent, and how far it may be extrapolated.
inline constexpr Range sink_delay_range{0, static_cast<double>(transport::Delay::most) / 1e9, "seconds"};
inline constexpr Range sink_lead_range{0, static_cast<double>(transport::most_lead) / 1e9, "seconds"};

/// Where ros_to_trk takes its sets from.
enum class OutgoingInput : std::uint8_t { params, tf };

/// Parameters of the node, with their defaults.
struct RosToTrkParameters {
  std::string name;                            ///< the camera's: names its diagnostics
  std::vector<transport::SinkEndpoint> sinks;  ///< at least one; each is written
  OutgoingInput input = OutgoingInput::params;
  /// What `format` or `preset`, `id`, `delay` and `lead` say: for sinks that do not say it themselves. Always has a
  /// format.
  transport::SinkForm form{wire::euler, true, std::nullopt, std::nullopt, std::nullopt};
  /// Hz: at most that of tf on arrival, else that of departures. None: that of what comes.
  std::optional<double> rate;
  /// Whether a timer sends, at an even rhythm. Default: for tf with a rate.
  bool pace = false;
  int queue_size = 100;  ///< messages that wait for the node

  // input: params
  std::optional<wire::CameraConstants> constants;  ///< until some are received

  // input: tf
  std::string studio_frame = "studio";
  std::string camera_frame;   ///< default: the camera's name
  bridge::TfToTrkOptions tf;  ///< the chip's width and height are required
};

/// Reads a node's private parameters; `camera_name` names the camera, and its frame where none is given. Throws
/// ParameterError with every fault.
RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
