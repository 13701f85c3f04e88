// What diagnostics say of what ros_to_trk sends: of its input and of every sink.
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
#include "transform_gate.h"

namespace trk_bridge::bridge {

/// One look at the input `params`.
struct ParamsReport {
  ParamsToTrkStatistics params;
  std::string topic;      ///< of CameraParams, as it is waited for
  std::int64_t time = 0;  ///< steady clock, ns, here and below
};

/// One look at the input `tf`.
struct TfReport {
  TfToTrkStatistics tf;
  TransformGateStatistics gate;
  std::string info_topic;      ///< as it is waited for
  std::string pose_fault;      ///< why tf has no pose now, in tf's own words; empty: it has one
  std::int64_t last_pose = 0;  ///< ns since 1970, stamp of the newest pose that tf gave; 0: none or a static one
  std::int64_t ahead = 0;      ///< ns that it was ahead of ROS time when it was found; 0: not known, or static
  std::int64_t time = 0;
};

/// One look at a sink.
struct SinkReport {
  OutletState state;
  transport::SinkForm form;
  OutletStatistics sink;
  std::optional<OutletQueueStatistics> queue;     ///< none: it is written at once
  std::optional<DepartureStatistics> departures;  ///< none: it is not paced
  std::int64_t time = 0;
};
SinkReport report_of(const Outlet&, const std::optional<DepartureStatistics>&, std::int64_t time);

/// What of a delay a person should know: "margin 0.97 fields, negative 0 times of 500, age 20.0 ms", of all that was
/// sent between the two.
std::string timing_text(const DepartureStatistics& now, const DepartureStatistics& before = {});

/// What `now` shows: the state first, and then what has gone wrong since `before` (the look before it; of
/// counters, only their growth is a finding). Nothing sent for a second, or of tf for silence_after(rate), is one.
std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before);
std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate);
std::vector<Finding> findings(const SinkReport& now, const SinkReport& before);

/// The findings as a summary, all counters as values. Rates are those between the looks.
void fill(Status& status, const std::vector<Finding>& found, const ParamsReport& now, const ParamsReport& before);
void fill(Status& status, const std::vector<Finding>& found, const TfReport& now, const TfReport& before);
void fill(Status& status, const std::vector<Finding>& found, const SinkReport& now, const SinkReport& before);

}  // namespace trk_bridge::bridge
