// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The model of `trk monitor`: statistics of a source and of every camera.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrival_window.h"
#include "bridge/camera_pipeline.h"
#include "cli/tally.h"
#include "findings.h"
#include "history.h"
#include "rest_window.h"
#include "time_code_counter.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::monitor {

/// The last malformed record.
struct MalformedState {
  transport::Fault fault;
  transport::Sender sender;
  double age = 0;  ///< s
};

/// The latest new parameters of a camera, and their meaning.
struct ParamsState {
  wire::CameraParams params;
  const char* origin = "";                  ///< how it was encoded
  camera::Result<Eigen::Isometry3d> pose;   ///< studio_T_camera, m
  camera::Result<camera::Lens> lens;        ///< mm, m
  camera::Result<double> horizontal_angle;  ///< degrees, of the full chip without distortion
  double age = 0;                           ///< s since they were received
  /// No new parameters for more than one second and more than three intervals.
  bool is_silent = false;
  std::optional<base::TimeCodeWithRate> time_code;
  transport::LensEncoders encoders = {};
  const char* doubt = "";  ///< transport::Sample::doubt
};

/// One id of one sender.
struct CameraState {
  cli::Tally::Key key;
  std::optional<ParamsState> latest;  ///< none if only constants were received
  std::optional<wire::CameraConstants> constants;
  base::SequenceCounts counts;
  std::optional<double> rate;  ///< Hz over the window of arrivals
  std::optional<Jitter> jitter;
  Rest rest;
  std::optional<double> loss;           ///< percent of this id's records within the last seconds
  std::vector<std::int64_t> intervals;  ///< ns, over the window of arrivals
  /// For plots; null if there is none. Refers to the model and is valid until records are added: see frozen().
  std::shared_ptr<const History> history;
};

struct State {
  std::string source_name;
  double age = 0;  ///< s since the model was created
  /// The most important first; never empty.
  std::vector<bridge::Finding> findings;
  transport::SourceStatistics source;
  std::optional<MalformedState> malformed;
  std::vector<CameraState> cameras;    ///< by id and sender, active ones before silent ones
  std::uint64_t not_shown = 0;         ///< records of more cameras than cli::Tally::most_cameras
  std::uint64_t recent_malformed = 0;  ///< within the last seconds (Model::findings_span)
  std::uint64_t recent_drops = 0;      ///< by the kernel, within the same time
};
/// A copy that does not change with the model.
State frozen(State);

/// Not synchronised. Reads no clock: `now` is the time at which a record was received or the state is requested, and is
/// used for ages. Rate, jitter and noise are computed from the arrival of the records: the time stamp of the kernel for
/// UDP, the time code for files.
class Model {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `before`: counts of the source before `begin`, which are subtracted (after a reset).
  explicit Model(Time begin, transport::SourceStatistics before = {});

  void add(const transport::Sample&, Time now);
  void add_malformed(const transport::Reception&, Time now);

  /// Findings compare with earlier states: call this at least every second.
  State state(Time now, const transport::Source&);

  /// Findings cover this time, s.
  static constexpr double findings_span = 5;

 private:
  struct Latest {
    wire::CameraParams params;
    bool has_lens;
    transport::LensEncoders encoders;
    const char* doubt;
    const char* origin;
    std::optional<base::TimeCodeWithRate> time_code;
    Time arrived;
  };
  /// One id of one sender.
  struct Track {
    std::optional<Latest> latest;
    std::optional<transport::Sample> constants;
    base::Sequence sequence;
    ArrivalWindow arrivals;
    RestWindow poses;
    History history;

    const wire::CameraConstants* constants_or_null() const;
  };
  /// One id of any sender, processed as by a receiver.
  struct Watched {
    bridge::CameraPipeline pipeline;
    TimeCodeCounter counter;
  };
  struct Malformed {
    transport::Fault fault;
    transport::Sender sender;
    Time arrived;
  };
  struct Snapshot {
    std::int64_t time = 0;  // steady clock, ns
    transport::SourceStatistics source;
    KernelCounters kernel;
    std::map<std::uint32_t, bridge::CameraStatistics> cameras;
  };

  static void add_params(Track&, const transport::Sample&, const wire::CameraParams&, Time now);
  void watch(const transport::Sample&, Time now);
  Watched& watched(std::uint32_t id, Time now);
  bridge::CameraReport report(const Snapshot&, std::optional<std::uint32_t> id, const std::string& source_name) const;
  SourceReports compare(Time now, const transport::Source&);
  static CameraState state_of(const cli::Tally::Key&, const Track&, Time now);

  Time begin_;
  transport::SourceStatistics before_;
  std::map<cli::Tally::Key, Track, cli::Tally::Less> tracks_;
  std::map<std::uint32_t, Watched> watched_;
  std::deque<Snapshot> snapshots_;
  std::optional<Malformed> malformed_;
  std::uint64_t not_shown_ = 0;
};

}  // namespace trk_bridge::monitor
