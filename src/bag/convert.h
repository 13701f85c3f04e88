// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk bag` in both directions.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "cameras.h"
#include "cli/long_run.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::bag {

struct TakeToBagOptions {
  std::string camera = "camera";
  std::string studio_frame = "studio";
  std::optional<std::string> camera_frame, optical_frame;  ///< none: the default names of trk_to_ros
  /// FormatBit mask of the params; none: as received, so that converting back gives the same take.
  std::optional<std::uint32_t> format;
  double field_rate = 50;                    ///< Hz
  std::int64_t midnight = default_midnight;  ///< when the time code was 00:00:00:00:1, ns since 1970 UTC
  std::optional<std::int64_t> start;         ///< of the first field, ns since 1970 UTC; the time code is not used then
  std::string compression = "none";          ///< none, bz2 or lz4
  bool overwrite = false;

  /// 1970-01-02: obviously not the day of the recording, which a take does not contain, and within the range of ROS
  /// time.
  static constexpr std::int64_t default_midnight = 86'400'000'000'000;
};

struct BagToTakeOptions {
  std::optional<std::string> camera;    ///< a namespace; none: the only camera of the bag
  std::optional<Input> input;           ///< none: params if there are any
  std::optional<double> field_rate;     ///< Hz; none: that of the bag, else 50
  std::optional<std::uint32_t> format;  ///< none: params unchanged, tf as euler
  std::optional<std::uint32_t> id;      ///< replaces the id in the bag
  std::string studio_frame = "studio";
  std::optional<std::string> camera_frame;        ///< none: the frame of camera_info
  bool camera_frame_is_optical = false;           ///< always true for the frame of camera_info
  std::optional<double> chip_width, chip_height;  ///< mm, for bags without constants
  bool overwrite = false;
};

/// Writes what trk_to_ros with format:=as_received, or with the format of the options, would have published for a take,
/// with stamps from its time code. Equal takes and options give equal files. Throws std::runtime_error and Interrupted,
/// and then leaves no file.
void bag_of_take(const std::string& take, const std::string& bag, const TakeToBagOptions&, cli::LongRun&,
                 std::ostream& err);

/// Converts a complete or truncated recording to a take. Reports on `err` what is missing. Throws like bag_of_take().
void take_of_bag(const std::string& bag, const std::string& take, const BagToTakeOptions&, cli::LongRun&,
                 std::ostream& err);

/// Throws transport::TransportError "PATH: cannot be written: reason" unless it was written.
void check_written(const std::string& path, const transport::WriteResult&);

}  // namespace trk_bridge::bag
