// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros_report.h"

#include "base/time_text.h"
#include "diagnostic_text.h"

namespace trk_bridge::bridge {
namespace {

const char* text_of(MasterState state) noexcept {
  switch (state) {
    case MasterState::unasked:
      return "not asked yet";
    case MasterState::knows_node:
      return "knows this node";
    case MasterState::silent:
      return "does not answer";
    case MasterState::forgot:
      return "does not know this node any more";
  }
  return "";
}

}  // namespace

std::vector<Finding> findings(const RosReport& now, const RosReport&) {
  std::vector<Finding> found;
  if (now.master == MasterState::silent) {
    warn(found, Condition::master_silent,
         "the master at " + now.master_uri + " does not answer: existing connections stay, but no new ones are made");
  }
  if (now.master == MasterState::forgot) {
    warn(found, Condition::master_forgot,
         "the master does not know this node any more, it was restarted: existing connections stay, but no new ones "
         "are made until "
         "the node is restarted, too");
  }
  if (now.is_simulated && now.time - now.ros_time_moved > ros_time_stands_after) {
    warn(found, Condition::ros_time_stands,
         now.ros_time == 0
             ? std::string(
                   "use_sim_time is set, but nothing is published on /clock: ROS time is 0. Without a simulation or "
                   "`rosbag play --clock`: rosparam delete /use_sim_time, then restart the node")
             : "use_sim_time is set, and /clock stands or has been silent for " +
                   duration_text(seconds_between(now.ros_time_moved, now.time)));
  }
  return found;
}

void fill(Status& status, const std::vector<Finding>& found, const RosReport& now, const RosReport&) {
  const char* const time_source = now.is_simulated ? "/clock" : "the system's clock";
  status.hardware_id = now.master_uri;
  summarize(found, status);
  if (found.empty()) status.message = std::string("the master ") + text_of(now.master) + "; ROS time is " + time_source;
  status.add("master", text_of(now.master));
  status.add("age of the master's last answer (s)", age_text(now.answered != 0, now.answered, now.time));
  status.add("time source", time_source);
  status.add("ROS time", base::seconds_text(now.ros_time));
}

}  // namespace trk_bridge::bridge
