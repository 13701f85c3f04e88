// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A measurement in words, numbers and JSON.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "meter.h"

namespace trk_bridge::delay {

/// "the video is 41.3 ms later than tracking (2.07 fields)", or "cannot tell: " and the reason. `field` in s, here and
/// below.
std::string summary(const Measurement&, double field);

/// Faults of tracking, one line each: an axis with a wrong sign, a wrong scale or focal length.
std::vector<std::string> faults(const Measurement&);

/// Names with units, and numbers. Without a delay, only the values that are known anyway.
std::vector<std::pair<std::string, std::string>> values(const Measurement&, double field);

/// The parameter to set for this delay; empty if there is none.
std::string setting(const Measurement&);

/// All of the above as one object. Times are in s; unknown values are null.
std::string to_json(const Measurement&, double field);

}  // namespace trk_bridge::delay
