#include "ros_to_trk_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

PLUGINLIB_EXPORT_CLASS(trk_bridge::nodes::RosToTrkNodelet, nodelet::Nodelet)
