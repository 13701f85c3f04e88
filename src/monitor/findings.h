// What is wrong with what comes, in words: those of the bridge's diagnostics, and what only a monitor looks for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arrival_window.h"
#include "bridge/diagnostics.h"
#include "bridge/finding.h"
#include "kernel_counters.h"

namespace trk_bridge::monitor {

/// Two looks at one id, and what is known of it besides.
struct CameraLooks {
  std::uint32_t id = 0;
  bridge::CameraReport now, before;
  Unevenness unevenness;
  std::string time_code;  ///< what of a time code its counter is; empty: none
};

/// Two looks at a source.
struct SourceLooks {
  bridge::CameraReport now, before;  ///< the camera counts for nothing
  KernelCounters missed;             ///< growth between them
  std::vector<CameraLooks> cameras;
};

/// As the bridge takes the records of one id when it makes nothing of them but findings.
bridge::CameraOptions watch_options(std::uint32_t id);

/// What a person should look at, the cause first: the worst level, then what explains others. What another one explains
/// is left out. Never empty: when nothing is wrong, the only ones are of level ok.
std::vector<bridge::Finding> findings_of(const SourceLooks&);

}  // namespace trk_bridge::monitor
