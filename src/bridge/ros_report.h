// What diagnostics say of ROS itself, as every node meets it: its master and its time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "finding.h"

namespace trk_bridge::bridge {

enum class MasterState : std::uint8_t {
  unasked,
  knows_node,
  silent,  ///< no answer
  forgot,  ///< it was restarted: what this node has registered is lost for good
};

/// One look at ROS.
struct RosReport {
  MasterState master = MasterState::unasked;
  std::string master_uri;
  std::int64_t answered = 0;        ///< when the master last did, steady clock, ns
  bool is_simulated = false;        ///< ROS time comes from /clock
  std::int64_t ros_time = 0;        ///< ns
  std::int64_t ros_time_moved = 0;  ///< when it was first found to be this, steady clock, ns
  std::int64_t time = 0;            ///< steady clock, ns
};

/// ns; simulated time that is the same for so long stands.
inline constexpr std::int64_t ros_time_stands_after = 2'000'000'000;

std::vector<Finding> findings(const RosReport& now, const RosReport& before);
void fill(Status& status, const std::vector<Finding>& found, const RosReport& now, const RosReport& before);

}  // namespace trk_bridge::bridge
