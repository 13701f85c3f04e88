// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The parameters of delay_meter.
#pragma once

#include <optional>
#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// Parameters of the node, with their defaults.
struct DelayMeterParameters {
  std::string name;                                ///< of the camera and its diagnostics
  double window = 15;                              ///< s of video that are compared
  double most_delay = 0.5;                         ///< s, in both directions
  std::optional<double> field_rate;                ///< Hz; none: the rate of params
  std::optional<wire::CameraConstants> constants;  ///< used until others are received
  int queue_size = 100;                            ///< messages of params
};

/// Reads the private parameters of a node; `camera_name` is the name of the camera. Throws ParameterError with all
/// faults.
DelayMeterParameters read_delay_meter_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
