// ros_to_trk inside a nodelet manager.
#pragma once

#include "ros_to_trk.h"
#include "running_nodelet.h"

namespace trk_bridge::nodes {

class RosToTrkNodelet : public RunningNodelet<RosToTrk> {};

}  // namespace trk_bridge::nodes
