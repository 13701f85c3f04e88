// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Something that people should know: its kind, its level and a text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "status.h"

namespace trk_bridge::bridge {

/// The kind of a finding. The log shows each kind once.
enum class Condition : std::uint8_t {
  // of trk_to_ros
  receiving,
  waiting,
  ended,
  failed,
  nothing_valid,
  only_refused,
  other_ids_only,
  constants_only,
  nothing_new,
  counter_frozen,
  uncounted,
  foreign_sender,
  failover,
  ports_change,
  lost,
  malformed,
  doubtful,
  refused,
  kernel_drops,
  unknown_ids,
  several_ids,
  dropped,
  unstampable,
  no_constants,
  bad_constants,
  pose_only,
  withheld,
  no_camera_info,
  no_markers,
  stamps_held,
  stamps_are_arrivals,
  path_stepped,
  counter_restarted,
  rate_changed,
  source_clock_off,
  clock_stepped,
  // of both
  lens_inexact,
  // of ros_to_trk, which also uses some of those above
  sending,
  id_not_sent,
  bad_camera_info,
  tf_restarted,
  tf_refused,
  clocks_differ,
  tangential_lost,
  rows_disagree,
  bad_lens,
  sink_hangs,
  sink_notice,
  sink_fails,
  sink_loses,
  sink_too_slow,
  queue_drops,
  delay_too_short,
  // of trk monitor, which also uses most of those of trk_to_ros
  other_interface,
  time_code_counter,
  bursts,
  stalls,
  rate,
  alarm,
  // of every node
  ros_time_stands,
  master_silent,
  master_forgot,
};

/// A condition that holds, and a line of text for people.
struct Finding {
  Condition condition;
  Level level;
  std::string text;
  /// An event: the log shows each one, not only the first of its kind.
  bool is_event = false;
};

/// Adds a finding with Level::warn.
void warn(std::vector<Finding>& found, Condition condition, std::string text);

/// The worst level and all texts, joined.
void summarize(const std::vector<Finding>& found, Status& status);

}  // namespace trk_bridge::bridge
