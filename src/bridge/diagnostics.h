// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Diagnostics of a camera and its source.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "camera_info.h"
#include "camera_pipeline.h"
#include "finding.h"
#include "status.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::bridge {

/// What a reader counts in addition to its source. Trivially copyable.
struct ReaderStatistics {
  std::uint64_t unknown_id_records = 0;        ///< records with an id that no camera has
  std::array<std::uint32_t, 8> unknown_ids{};  ///< the first distinct ones
  std::uint32_t unknown_id_count = 0;          ///< how many of `unknown_ids` are valid
  bool has_fault = false;
  transport::Fault last_fault{};  ///< of the last malformed record
};

/// Trivially copyable.
struct MarkerStatistics {
  std::uint64_t not_drawn = 0;  ///< CameraInfos whose lens cannot be drawn; reason of the last one: `reason`
  InfoFault reason;
};

/// The state of a camera at one time.
struct CameraReport {
  std::string source_name;
  transport::SourceStatistics source;
  ReaderStatistics reader;
  CameraStatistics camera;
  MarkerStatistics markers;
  std::int64_t time = 0;  ///< steady clock, ns
};

/// Seconds without new samples after which a camera counts as silent: one second or five fields, whichever is longer.
inline double silence_after(double field_rate) { return std::max(1.0, 5.0 / field_rate); }

/// The findings in `now`: first the state, then what has gone wrong since the report `before`. A counter is a finding
/// only if it has grown. No new samples for silence_after() is a finding.
std::vector<Finding> findings(const CameraReport& now, const CameraReport& before, const CameraOptions& options,
                              double field_rate);

/// The findings as a summary (worst level; texts joined), all counters as values. The rate is measured between the
/// reports.
void fill(Status& status, const std::vector<Finding>& found, const CameraReport& now, const CameraReport& before);

}  // namespace trk_bridge::bridge
