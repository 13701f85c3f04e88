// What diagnostics say of a camera and its source: states as they are, never better.
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

/// What a reader noticed besides what its source counts. Trivially copyable.
struct ReaderStatistics {
  std::uint64_t unknown_id_records = 0;        ///< records with an id that no camera wants
  std::array<std::uint32_t, 8> unknown_ids{};  ///< the first different ones of them
  std::uint32_t unknown_id_count = 0;          ///< how many of these are valid
  bool has_fault = false;
  transport::Fault last_fault{};  ///< of the last malformed record
};

/// What became of a camera's markers so far. Trivially copyable.
struct MarkerStatistics {
  std::uint64_t not_drawn = 0;  ///< CameraInfos whose lens cannot be drawn; `reason` of the last one
  InfoFault reason;
};

/// One look at a camera.
struct CameraReport {
  std::string source_name;
  transport::SourceStatistics source;
  ReaderStatistics reader;
  CameraStatistics camera;
  MarkerStatistics markers;
  std::int64_t time = 0;  ///< steady clock, ns
};

/// Seconds after which a camera that sends nothing new is silent: one, or five fields where these are longer.
inline double silence_after(double field_rate) { return std::max(1.0, 5.0 / field_rate); }

/// What `now` shows, the state first and then what has gone wrong since `before` (the look before it; of counters, only
/// their growth is a finding). Nothing new for silence_after() is a finding.
std::vector<Finding> findings(const CameraReport& now, const CameraReport& before, const CameraOptions& options,
                              double field_rate);

/// The findings as a summary (worst level; texts joined), all counters as values. The rate is that between the looks.
void fill(Status& status, const std::vector<Finding>& found, const CameraReport& now, const CameraReport& before);

}  // namespace trk_bridge::bridge
