// The parameters of delay_meter.
#pragma once

#include <optional>
#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// Parameters of the node, with their defaults.
struct DelayMeterParameters {
  std::string name;                                ///< the camera's: names its diagnostics
  double window = 15;                              ///< s of video that are compared
  double most_delay = 0.5;                         ///< s, to both sides
  std::optional<double> field_rate;                ///< Hz; none: the rate of params
  std::optional<wire::CameraConstants> constants;  ///< until some are received
  int queue_size = 100;                            ///< params that wait for the node
};

/// Reads a node's private parameters; `camera_name` names the camera. Throws ParameterError with every fault.
DelayMeterParameters read_delay_meter_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
