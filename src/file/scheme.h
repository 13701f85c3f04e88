// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The scheme file: takes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "recording_name.h"
#include "transport/scheme.h"
#include "trk_bridge/base/time_code.h"

namespace trk_bridge::file {

/// Time of the samples of a file.
enum class FileTime : std::uint8_t {
  timecode,  ///< the time code of the first field on `date`, plus the time of the fields since then
  now,       ///< the time when a sample is returned
};

/// Midnight of 2249-12-31, seconds since 1970: nanoseconds since 1970 overflow in 2262, and a take needs some time.
inline constexpr std::int64_t latest_date = 8'835'868'800;

/// `file:PATH?rate=…&speed=…&loop=1&time=…&date=…&lenient=1`, to play a take.
struct SourceSettings {
  std::string path;
  std::optional<double> rate;  ///< Hz, 0.001 to 100000: video fields per second
  double speed = 1.0;          ///< 0.001 to 1000; 0: as fast as possible
  bool loop = false;
  FileTime time = FileTime::timecode;
  /// Midnight UTC, seconds since 1970, at most latest_date; default: the day of opening.
  std::optional<std::int64_t> date;
  bool lenient = false;  ///< malformed lines are skipped
};

/// `file:PATH?timecode=…&rate=…&number=1&overwrite=1`, to record a take.
struct SinkSettings {
  RecordingName path;
  /// Of the first field; default: that of the field, else its time of day, UTC.
  std::optional<base::TimeCode> time_code;
  double rate = 50;        ///< Hz, 1 to 200, of the default time code
  bool number = false;     ///< add the next free number to the name
  bool overwrite = false;  ///< not together with `number`
};

/// Errors name the part of the URL, its value and what is allowed.
tl::expected<SourceSettings, std::string> source_settings(const transport::Url&);
tl::expected<SinkSettings, std::string> sink_settings(const transport::Url&);

/// Throws TransportError. A FIFO is opened at once; its lines are read as they arrive. `field_rate` (Hz) is used if the
/// settings have no `rate`.
std::unique_ptr<transport::Source> open_source(const SourceSettings&, double field_rate);
/// Does not open the file yet (see Sink::prepare). If it cannot be opened, writes try again, at most every second.
std::unique_ptr<transport::Sink> open_sink(const SinkSettings&);

extern const transport::Scheme scheme;

}  // namespace trk_bridge::file
