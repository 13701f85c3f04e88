// What every node's main does.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

namespace trk_bridge::nodes {

/// Runs a `Node`, made from (node handle, private node handle, full name), until ROS shuts down. Returns the exit
/// status: 1 and a fatal message with the reason when it cannot start, 2 for arguments that nobody knows.
template <typename Node>
int node_main(int argc, char** argv, const char* name) {
  std::vector<std::string> arguments;
  ::ros::removeROSArgs(argc, argv, arguments);
  ::ros::init(argc, argv, name);
  if (arguments.size() > 1) {
    ROS_FATAL_STREAM(name << ": unknown argument '" << arguments[1] << "'; it takes parameters (_name:=value) alone");
    return 2;
  }
  // Outlives the catch: with the last handle ROS shuts down, and the log with it.
  const ::ros::NodeHandle node;
  try {
    const Node running(node, ::ros::NodeHandle("~"), ::ros::this_node::getName());
    ::ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(::ros::this_node::getName() << " cannot start: " << error.what());
    return 1;
  }
  return 0;
}

}  // namespace trk_bridge::nodes
