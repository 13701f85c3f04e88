// What diagnostics say of what ros_to_trk sends: of its input and of every sink.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "finding.h"
#include "params_to_trk.h"
#include "tf_to_trk.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::ros1 {

/// One look at the input `params`.
struct ParamsReport {
  ParamsToTrkStatistics params;
  std::string topic;      ///< of CameraParams, as it is waited for
  std::int64_t time = 0;  ///< steady clock, ns, here and below
};

/// One look at the input `tf`.
struct TfReport {
  TfToTrkStatistics tf;
  std::string info_topic;      ///< as it is waited for
  std::string pose_fault;      ///< why tf has no pose now, in tf's own words; empty: it has one
  std::int64_t last_pose = 0;  ///< ns since 1970, stamp of the newest pose that tf gave; 0: none or one for ever
  std::int64_t time = 0;
};

/// What became of one sink's sets so far. Trivially copyable.
struct SinkState {
  transport::SinkStatistics counts;
  std::uint64_t failed_sets = 0;                                   ///< sets of which something did not go out
  bool fails = false;                                              ///< the last one was such
  transport::SinkFault last_fault{transport::SinkReason::closed};  ///< counts once failed_sets > 0
  std::int64_t last_failure = 0, last_success = 0;
};

/// One look at a sink.
struct SinkReport {
  std::string name;
  SinkState sink;
  std::int64_t time = 0;
};

/// What `now` tells, the state first and then what has gone wrong since `before` (the look before it; of counters, only
/// their growth is a finding). Nothing sent for a second, or five periods of `rate` where these are longer, is one.
std::vector<Finding> findings(const ParamsReport& now, const ParamsReport& before);
std::vector<Finding> findings(const TfReport& now, const TfReport& before, double rate);
std::vector<Finding> findings(const SinkReport& now, const SinkReport& before);

/// The findings as a summary, all counters as values. Rates are those between the looks.
void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found,
          const ParamsReport& now, const ParamsReport& before, const OutgoingForm& form);
void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found, const TfReport& now,
          const TfReport& before, const OutgoingForm& form);
void fill(diagnostic_updater::DiagnosticStatusWrapper& status, const std::vector<Finding>& found, const SinkReport& now,
          const SinkReport& before);

}  // namespace trk_bridge::ros1
