// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trk endpoints to ROS topics and tf; shared by the node and the nodelet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "camera_output.h"
#include "node_diagnostics.h"
#include "source_reader.h"

namespace trk_bridge::nodes {

/// Runs from construction to destruction. Diagnostics are published from the callback queue of `node`, records from the
/// threads of the readers, static transforms and the constants of the parameters from the constructor.
class TrkToRos {
 public:
  /// Topics are in the namespace of `node`, parameters in that of `private_node`; `name` is the full name of the node
  /// or nodelet. Throws ParameterError and TransportError.
  TrkToRos(const ::ros::NodeHandle& node, ::ros::NodeHandle private_node, const std::string& name);

 private:
  void open(const ros1::TrkToRosParameters&, const ::ros::Publisher& markers);
  void send_static_transforms();
  /// Services `set_delay`, `set_publish_tf` and `set_publish_camera_info` of one camera.
  void advertise_services(CameraOutput&, ::ros::NodeHandle);

  ::ros::NodeHandle node_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::vector<std::unique_ptr<CameraOutput>> cameras_;
  std::vector<std::unique_ptr<SourceReader>> readers_;
  std::vector<::ros::ServiceServer> services_;
  NodeDiagnostics diagnostics_;
};

}  // namespace trk_bridge::nodes
