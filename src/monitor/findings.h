// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Problems of the received data as text: the findings of the bridge's diagnostics, and those that only the monitor has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arrival_window.h"
#include "bridge/diagnostics.h"
#include "bridge/finding.h"
#include "kernel_counters.h"

namespace trk_bridge::monitor {

/// Two reports of one id, and more data about it.
struct CameraReports {
  std::uint32_t id = 0;
  bridge::CameraReport now, before;
  Unevenness unevenness;
  std::string time_code;  ///< how its counter encodes a time code; empty: it does not
};

/// Two reports of a source.
struct SourceReports {
  bridge::CameraReport now, before;  ///< their `camera` is not used
  KernelCounters missed;             ///< growth between them
  std::vector<CameraReports> cameras;
};

/// Options with which the bridge processes the records of one id for findings only.
bridge::CameraOptions watch_options(std::uint32_t id);

/// The findings, sorted: the worst level first, then causes before others. Findings that another one explains are
/// removed. Never empty: if nothing is wrong, all have level ok.
std::vector<bridge::Finding> findings_of(const SourceReports&);

}  // namespace trk_bridge::monitor
