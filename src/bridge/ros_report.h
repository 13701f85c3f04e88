// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Diagnostics of the ROS master and of ROS time, for every node.
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
  forgot,  ///< it was restarted: the registrations of this node are lost
};

/// The state of ROS at one time.
struct RosReport {
  MasterState master = MasterState::unasked;
  std::string master_uri;
  std::int64_t answered = 0;        ///< when the master last answered, steady clock, ns
  bool is_simulated = false;        ///< ROS time comes from /clock
  std::int64_t ros_time = 0;        ///< ns
  std::int64_t ros_time_moved = 0;  ///< when it last changed, steady clock, ns
  std::int64_t time = 0;            ///< steady clock, ns
};

/// ns; simulated time that does not change for this long counts as stopped.
inline constexpr std::int64_t ros_time_stands_after = 2'000'000'000;

std::vector<Finding> findings(const RosReport& now, const RosReport& before);
void fill(Status& status, const std::vector<Finding>& found, const RosReport& now, const RosReport& before);

}  // namespace trk_bridge::bridge
