// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Code shared by all nodes, as programs and as nodelets. A `Node` is constructed from (node handle, private node
// handle, full name) and runs from construction to destruction.
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "nodelet_name.h"
#include "ros/parameter_reader.h"

#include "base/process.h"

namespace trk_bridge::nodes {

/// The result of `read` for all private parameters (an invalid value if there are none). Adds the remedy to a
/// ParameterError.
template <typename Read>
auto read_parameters(const ::ros::NodeHandle& private_node, const Read& read) {
  XmlRpc::XmlRpcValue tree;
  private_node.getParam(private_node.getNamespace(), tree);
  try {
    return read(tree);
  } catch (const ros1::ParameterError& error) {
    throw error.with_remedy(private_node.getNamespace());
  }
}

/// The last element of a namespace is the name of its camera; `camera` in the root namespace.
inline std::string camera_name_of(const std::string& name_space) {
  const std::string last = name_space.substr(name_space.find_last_of('/') + 1);
  return last.empty() ? "camera" : last;
}

/// Runs a `Node` until ROS shuts down or SIGINT or SIGTERM is received. Returns the exit status: 1 with a fatal message
/// if it cannot start, 2 for unknown arguments.
template <typename Node>
int node_main(int argc, char** argv, const char* name) {
  base::open_standard_descriptors();
  std::vector<std::string> arguments;
  ::ros::removeROSArgs(argc, argv, arguments);
  ::ros::init(argc, argv, name, ::ros::init_options::NoSigintHandler);
  const base::StopSignals signals;
  if (arguments.size() > 1) {
    ROS_FATAL_STREAM(name << ": unknown argument '" << arguments[1]
                          << "'; only parameters (_name:=value) are accepted");
    return 2;
  }
  // Must outlive the catch block: ROS and its log shut down with the last handle.
  const ::ros::NodeHandle node;
  try {
    const Node running(node, ::ros::NodeHandle("~"), ::ros::this_node::getName());
    // Like ros::spin(), but the node is destroyed while the log still works.
    while (::ros::ok() && !base::StopSignals::received()) {
      ::ros::getGlobalCallbackQueue()->callAvailable(::ros::WallDuration(0.1));
    }
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(::ros::this_node::getName() << " cannot start: " << error.what());
    return 1;
  }
  return 0;
}

/// Runs a `Node` from loading to unloading. If it cannot start, it logs a fatal message with the reason and throws, so
/// that loading fails.
template <typename Node>
class RunningNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      name_.emplace(getName());
      running_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(getName() << " cannot start: " << error.what());
      throw;
    }
  }

  std::optional<NodeletName> name_;  // released after the node is destroyed
  std::unique_ptr<Node> running_;
};

}  // namespace trk_bridge::nodes
