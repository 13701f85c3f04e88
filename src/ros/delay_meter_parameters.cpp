// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "delay_meter_parameters.h"

#include "parameter_reader.h"
#include "trk_to_ros_parameters.h"

namespace trk_bridge::ros1 {

DelayMeterParameters read_delay_meter_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& camera_name) {
  ParameterReader node(tree);
  DelayMeterParameters parameters;
  parameters.name = camera_name;
  check_camera_name(camera_name, node);
  node.diagnostic_period();
  node.number("window", parameters.window, {4, 120, "seconds"});
  node.number("most_delay", parameters.most_delay, {0.05, 1, "seconds"});
  double field_rate = 0;
  if (node.number("field_rate", field_rate, field_rate_range)) parameters.field_rate = field_rate;
  node.constants("constants", parameters.constants);
  node.integer("queue_size", parameters.queue_size, {1, 100000});
  // Read by image_transport.
  node.know("image_transport");
  node.finish();
  return parameters;
}

}  // namespace trk_bridge::ros1
