// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Diagnostics of ros_to_trk: of its input and of every sink.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "finding.h"
#include "outlet.h"
#include "paced_camera.h"
#include "params_to_trk.h"
#include "tf_to_trk.h"
#include "transform_filter.h"

namespace trk_bridge::bridge {

/// The state of the input `params` at one time.
struct ParamsReport {
  ParamsToTrkStatistics params;
  std::string topic;      ///< of CameraParams, resolved
  std::int64_t time = 0;  ///< steady clock, ns, here and below
};

/// The state of the input `tf` at one time.
struct TfReport {
  TfToTrkStatistics tf;
  TransformFilterStatistics filter;
  std::string info_topic;      ///< resolved
  std::string pose_fault;      ///< why tf has no pose now, in the words of tf; empty: it has one
  std::int64_t last_pose = 0;  ///< ns since 1970, stamp of the newest pose of tf; 0: none, or a static one
  std::int64_t ahead = 0;  ///< ns that this stamp was ahead of ROS time when it was received; 0: not known, or static
  std::int64_t time = 0;
};

/// The state of a sink at one time.
struct SinkReport {
  OutletState state;
  transport::SinkForm form;
  OutletStatistics sink;
  std::optional<OutletQueueStatistics> queue;     ///< none: there is no queue
  std::optional<DepartureStatistics> departures;  ///< none: it is not paced
  std::int64_t time = 0;
};
SinkReport report_of(const Outlet&, const std::optional<DepartureStatistics>&, std::int64_t time);

/// A summary of the delay for people: "margin 0.97 fields, negative 0 times of 500, age 20.0 ms", of everything that
/// was sent between the two reports.
std::string timing_text(const DepartureStatistics& now, const DepartureStatistics& before = {});

/// The findings in `now`: first the state, then what has gone wrong since the report `before`. A counter is a finding
/// only if it has grown. Nothing sent for one second (tf: silence_after(rate)) is a finding.
std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before);
std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate);
std::vector<Finding> findings(const SinkReport& now, const SinkReport& before);

/// The findings as a summary, all counters as values. Rates are measured between the reports.
void fill(Status& status, const std::vector<Finding>& found, const ParamsReport& now, const ParamsReport& before);
void fill(Status& status, const std::vector<Finding>& found, const TfReport& now, const TfReport& before);
void fill(Status& status, const std::vector<Finding>& found, const SinkReport& now, const SinkReport& before);

}  // namespace trk_bridge::bridge
