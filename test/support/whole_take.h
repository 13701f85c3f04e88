// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A complete take in memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "file/take.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {

struct Take {
  /// A line that is missing from the take.
  struct Skipped {
    std::size_t position;  ///< in `params`, of the line behind it
    transport::Fault fault;
  };

  base::TimeCode time_code;
  wire::CameraConstants constants;
  std::vector<wire::CameraParams> params;
  std::vector<Skipped> skipped;  ///< lines: a truncated last one, and with MalformedLines::are_skipped others
};

/// Throws transport::TransportError with the reader's message.
inline Take read_take(const std::string& path, MalformedLines malformed = MalformedLines::are_errors) {
  TakeReader reader(path, malformed, Waiting::blocks);
  Take take;
  for (;;) {
    switch (reader.next()) {
      case TakeReader::Got::head:
        take.time_code = reader.time_code();
        take.constants = reader.constants();
        break;
      case TakeReader::Got::params:
        take.params.push_back(reader.params());
        break;
      case TakeReader::Got::skipped:
      case TakeReader::Got::truncated:
        take.skipped.push_back({take.params.size(), reader.fault()});
        break;
      case TakeReader::Got::end:
        return take;
      case TakeReader::Got::nothing_yet:
      case TakeReader::Got::failed:
        throw transport::TransportError(reader.error());
    }
  }
}

}  // namespace trk_bridge::file
