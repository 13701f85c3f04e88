// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A received record as one line: JSON for programs, plain text for people.
#pragma once

#include <string>
#include <string_view>

#include <rapidjson/stringbuffer.h>

#include "trk_bridge/transport/source.h"

namespace trk_bridge::tools {

/// One JSON object per record. Doubles are the shortest text that gives the same double; `arrival` is seconds since
/// 1970 UTC with nine decimals, which is more exact than a double; values that are not finite are null. The view is
/// valid until the next call.
class JsonLine {
 public:
  std::string_view of(const transport::Sample&);

 private:
  rapidjson::StringBuffer buffer_;
};

/// The same for people: time, sender, id, counter, format words, and every number with its unit.
std::string plain_line(const transport::Sample&);

}  // namespace trk_bridge::tools
