// Where a node's parameters are.
#pragma once

#include <string>

#include <ros/node_handle.h>

namespace trk_bridge::nodes {

/// All private parameters; an invalid value when there are none.
inline XmlRpc::XmlRpcValue private_parameters(const ::ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue tree;
  private_node.getParam(private_node.getNamespace(), tree);
  return tree;
}

/// The last element of a namespace names the camera in it; `camera` in the root.
inline std::string camera_name_of(const std::string& name_space) {
  const std::string last = name_space.substr(name_space.find_last_of('/') + 1);
  return last.empty() ? "camera" : last;
}

}  // namespace trk_bridge::nodes
