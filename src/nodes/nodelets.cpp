// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "node.h"
#include "ros_to_trk.h"
#include "trk_to_ros.h"

namespace trk_bridge::nodes {

using TrkToRosNodelet = RunningNodelet<TrkToRos>;
using RosToTrkNodelet = RunningNodelet<RosToTrk>;

}  // namespace trk_bridge::nodes

PLUGINLIB_EXPORT_CLASS(trk_bridge::nodes::TrkToRosNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(trk_bridge::nodes::RosToTrkNodelet, nodelet::Nodelet)
