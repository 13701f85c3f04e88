// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
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

/// Limits of delay and extrapolation (lead).
inline constexpr Range sink_delay_range{0, static_cast<double>(transport::Delay::most) / 1e9, "seconds"};
inline constexpr Range sink_lead_range{0, static_cast<double>(transport::most_lead) / 1e9, "seconds"};

/// The input of ros_to_trk.
enum class OutgoingInput : std::uint8_t { params, tf };

/// Parameters of the node, with their defaults.
struct RosToTrkParameters {
  std::string name;                            ///< of the camera and its diagnostics
  std::vector<transport::SinkEndpoint> sinks;  ///< at least one
  OutgoingInput input = OutgoingInput::params;
  /// From `format` or `preset`, `id`, `delay` and `lead`: defaults for sinks whose URLs do not set them. Always has a
  /// format.
  transport::SinkForm form{wire::euler, true, std::nullopt, std::nullopt, std::nullopt};
  /// Hz: without pace the upper limit for tf, with pace the rate of departures. None: the rate of the input.
  std::optional<double> rate;
  /// Whether a timer sends, at an even rhythm. Default: for tf with a rate.
  bool pace = false;
  int queue_size = 100;  ///< messages

  // input: params
  std::optional<wire::CameraConstants> constants;  ///< used until others are received

  // input: tf
  std::string studio_frame = "studio";
  std::string camera_frame;   ///< default: the name of the camera
  bridge::TfToTrkOptions tf;  ///< width and height of the chip are required
};

/// Reads the private parameters of a node; `camera_name` is the name of the camera and the default of its frame. Throws
/// ParameterError with all faults.
RosToTrkParameters read_ros_to_trk_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name);

}  // namespace trk_bridge::ros1
