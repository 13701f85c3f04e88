// `trk bag`, both ways.
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
  std::optional<std::string> camera_frame, optical_frame;  ///< none: as trk_to_ros names them
  /// FormatBit mask of the params; none: as received, so that the way back gives the same take.
  std::optional<std::uint32_t> format;
  double field_rate = 50;                    ///< Hz
  std::int64_t midnight = default_midnight;  ///< when the time code was 00:00:00:00:1, ns since 1970 UTC
  std::optional<std::int64_t> start;         ///< of the first field, ns since 1970 UTC; the time code is not used then
  std::string compression = "none";          ///< none, bz2 or lz4
  bool overwrite = false;

  /// 1970-01-02: clearly not the day of the recording, which a take does not contain, and within ROS's range of time.
  static constexpr std::int64_t default_midnight = 86'400'000'000'000;
};

struct BagToTakeOptions {
  std::optional<std::string> camera;    ///< a namespace; none: the bag's only one
  std::optional<Input> input;           ///< none: params where there are any
  std::optional<double> field_rate;     ///< Hz; none: as the bag says, else 50
  std::optional<std::uint32_t> format;  ///< none: params as they are, tf as euler
  std::optional<std::uint32_t> id;      ///< in place of the bag's
  std::string studio_frame = "studio";
  std::optional<std::string> camera_frame;        ///< none: the frame of camera_info
  bool camera_frame_is_optical = false;           ///< the frame of camera_info always is
  std::optional<double> chip_width, chip_height;  ///< mm, for bags without constants
  bool overwrite = false;
};

/// Writes what trk_to_ros with format:=as_received, or with the format of the options, would have published of a take,
/// stamped by its time code. Equal takes and options make equal files. Throws std::runtime_error, and Interrupted, and
/// then leaves nothing.
void bag_of_take(const std::string& take, const std::string& bag, const TakeToBagOptions&, cli::LongRun&,
                 std::ostream& err);

/// Makes a take of a recording, whole or cut short. What is missing is reported on `err`. Throws as the above.
void take_of_bag(const std::string& bag, const std::string& take, const BagToTakeOptions&, cli::LongRun&,
                 std::ostream& err);

/// Throws transport::TransportError "PATH: cannot be written: reason" unless it was.
void check_written(const std::string& path, const transport::Written&);

}  // namespace trk_bridge::bag
