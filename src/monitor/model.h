// What `trk monitor` knows of a source: the statistics of every camera at one moment.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "arrival_window.h"
#include "cli/tally.h"
#include "rest_window.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::monitor {

/// The last malformed record.
struct MalformedState {
  transport::Fault fault;
  transport::Sender sender;
  double age = 0;  ///< s
};

/// The latest parameters of a camera that were new, and what they mean.
struct ParamsState {
  wire::CameraParams params;
  const char* origin = "";                  ///< how it was encoded
  camera::Result<Eigen::Isometry3d> pose;   ///< studio_T_camera, m
  camera::Result<camera::Lens> lens;        ///< mm, m
  camera::Result<double> horizontal_angle;  ///< degrees, of the whole chip without distortion
  double age = 0;                           ///< s since they were handed out
  /// Nothing new for more than a second and more than three intervals.
  bool is_silent = false;
  std::optional<base::CountedTimeCode> time_code;
  transport::LensEncoders encoders = {};
  const char* doubt = "";  ///< transport::Sample::doubt
};

/// One id of one sender.
struct CameraState {
  cli::Tally::Key key;
  std::optional<ParamsState> latest;  ///< none when only constants have come
  std::optional<wire::CameraConstants> constants;
  base::SequenceCounts counts;
  std::optional<double> rate;  ///< Hz over the window of arrivals
  std::optional<Jitter> jitter;
  Rest rest;
};

struct State {
  std::string source_name;
  transport::SourceStatistics source;
  std::optional<MalformedState> malformed;
  std::vector<CameraState> cameras;  ///< by id and sender, those that send before the silent ones
  std::uint64_t not_shown = 0;       ///< records of more cameras than cli::Tally::most_cameras
};

/// Not synchronised. Reads no clock: `now` is when a record was handed out or the state is asked for, and gives the
/// ages. Rate, jitter and noise are computed from the arrival of the records, which is the kernel's time stamp for UDP
/// and the time code for files.
class Model {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void add(const transport::Sample&, Time now);
  void add_malformed(const transport::Reception&, Time now);

  State state(Time now, const transport::Source&) const;
  const cli::Tally& tally() const noexcept { return tally_; }

 private:
  struct Latest {
    wire::CameraParams params;
    bool has_lens;
    transport::LensEncoders encoders;
    const char* doubt;
    const char* origin;
    std::optional<base::CountedTimeCode> time_code;
    Time came;
  };
  struct Track {
    std::optional<Latest> latest;
    std::optional<wire::CameraConstants> constants;
    ArrivalWindow arrivals;
    RestWindow poses;
  };
  struct Malformed {
    transport::Fault fault;
    transport::Sender sender;
    Time came;
  };

  static void add_params(Track&, const transport::Sample&, const wire::CameraParams&, Time now);
  CameraState state_of(const cli::Tally::Key&, const Track&, Time now) const;

  cli::Tally tally_;
  std::map<cli::Tally::Key, Track, cli::Tally::Less> tracks_;
  std::optional<Malformed> malformed_;
  std::uint64_t not_shown_ = 0;
};

}  // namespace trk_bridge::monitor
