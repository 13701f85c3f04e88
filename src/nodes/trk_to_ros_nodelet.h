// trk_to_ros inside a nodelet manager.
#pragma once

#include "running_nodelet.h"
#include "trk_to_ros.h"

namespace trk_bridge::nodes {

class TrkToRosNodelet : public RunningNodelet<TrkToRos> {};

}  // namespace trk_bridge::nodes
