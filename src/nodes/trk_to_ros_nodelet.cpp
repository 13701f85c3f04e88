#include "trk_to_ros_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

PLUGINLIB_EXPORT_CLASS(trk_bridge::nodes::TrkToRosNodelet, nodelet::Nodelet)
