// A measurement in words, numbers and JSON.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "meter.h"

namespace trk_bridge::delay {

/// "the video is 41.3 ms later than tracking (2.07 fields)", or "cannot tell: " and why. `field` in s, here and below.
std::string summary(const Measurement&, double field);

/// What is wrong with tracking, a line each: an axis that turns the wrong way, a scale or focal length that is off.
std::vector<std::string> faults(const Measurement&);

/// Names, with units, and numbers. Without a delay only what is known then.
std::vector<std::pair<std::string, std::string>> values(const Measurement&, double field);

/// Where the delay is to be entered; empty where there is none.
std::string setting(const Measurement&);

/// All of the above as one object. Times are in s; what is not known is null.
std::string to_json(const Measurement&, double field);

}  // namespace trk_bridge::delay
