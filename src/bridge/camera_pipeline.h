// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The incoming path of one camera: checks senders and records, converts, stamps and calibrates.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "camera_options.h"
#include "constants_origin.h"
#include "counter_clock.h"
#include "sender_lock.h"
#include "stamper.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/transport/sample.h"

namespace trk_bridge::bridge {

/// Where the last stamp came from, and why it was not the source that the options ask for.
enum class StampState : std::uint8_t {
  arrival,
  learning,    ///< arrival: the rhythm of the counter is not known yet, or it has none
  no_counter,  ///< arrival: the protocol has no counter
  uncounted,   ///< arrival: the counter does not count
  counter,
  no_source_time,  ///< arrival: the record has no time of the sender
  source,
};

/// Statistics of a camera's records. Trivially copyable. A record is "new" if base::Sequence classifies it as new, or
/// if the protocol has no counter.
struct CameraStatistics {
  std::uint64_t params = 0;           ///< parameter records of the followed sender, in any order
  base::SequenceCounts sequence;      ///< `accepted` counts all new records
  std::uint64_t without_counter = 0;  ///< new records of a protocol without a counter
  std::uint64_t without_lens = 0;     ///< new records without a lens: only their pose is published
  std::uint64_t dropped = 0;          ///< new records not published at all; reason of the last one: `drop_reason`
  std::uint64_t unstampable = 0;      ///< those of `dropped` whose time is outside the range of ROS time
  std::uint64_t withheld = 0;  ///< records whose tf was published but not their params; reason: `withhold_reason`
  std::uint64_t without_camera_info = 0;  ///< new records without the CameraInfo that was wanted; reason: `info_reason`
  std::uint64_t bad_constants = 0;        ///< invalid constants (no picture is left): ignored
  std::uint64_t id_changes = 0;           ///< how often the id differed from that of the record before
  std::uint64_t foreign = 0;    ///< records of other senders than `sender`, ignored; the last one: `foreign_sender`
  std::uint64_t failovers = 0;  ///< how often the followed sender changed; the one before: `silent_sender`
  StampState stamp_state{};
  CounterClockStatistics rhythm;              ///< of the counter, even if stamps do not use it
  std::optional<std::int64_t> source_behind;  ///< ns, arrival minus the sender's time, of the last record that has one
  std::uint64_t held_stamps = 0;              ///< see Stamper
  std::int64_t stamp_ahead = 0;               ///< ns, see Stamper
  std::uint64_t clock_steps = 0;              ///< see Stamper
  std::int64_t clock_step = 0;                ///< ns, see Stamper
  std::uint32_t last_id = 0;
  std::uint32_t last_format = 0;  ///< as received
  ConstantsOrigin constants = ConstantsOrigin::none;
  camera::CameraReason drop_reason{}, withhold_reason{}, info_reason{};
  bool has_lens = true;                             ///< the last new record had a lens
  bool has_camera_info = false;                     ///< the last published record had a CameraInfo
  double fit_residual = 0;                          ///< pixels, of the last CameraInfo
  bool ignores_ports = false;                       ///< see SenderLock
  transport::Sender foreign_sender, silent_sender;  ///< valid once foreign > 0, failovers > 0
  transport::Sender sender;                         ///< of the last new record, like the members below
  const char* encoding = "";                        ///< transport::Sample::origin
  std::int64_t last_new = 0;                        ///< steady clock, ns; valid once sequence.accepted > 0
};

/// The input of a calibration.
struct Uncalibrated {
  camera::Result<camera::Lens> lens;
  std::optional<wire::CameraConstants> constants;  ///< as received
};

/// The encoder counts of a camera's lens.
struct CameraEncoders {
  std::uint32_t id = 0;
  transport::LensEncoders counts;
};

/// What one sample leads to publish, all with one stamp.
struct CameraUpdate {
  std::int64_t stamp = 0;                           ///< ns since 1970 UTC; 0: no time is known (only for constants)
  std::optional<wire::CameraConstants> constants;   ///< set if they changed; valid for params in the published format
  std::optional<wire::CameraParams> params;         ///< in the published format
  std::optional<camera::Calibration> calibration;   ///< for CameraInfo
  std::optional<Eigen::Isometry3d> pose;            ///< studio_T_camera, m
  std::optional<base::TimeCodeWithRate> time_code;  ///< of parameters, if the protocol has one
  std::optional<CameraEncoders> encoders;           ///< likewise
  std::optional<Uncalibrated> uncalibrated;         ///< input of CameraPipeline::calibrate(), if one is wanted

  bool is_empty() const noexcept { return stamp == 0 && !constants; }
};

/// Not synchronised: one thread at a time. Never allocates.
class CameraPipeline {
 public:
  /// `field_rate` in Hz, see base::Sequence; none: it is measured.
  CameraPipeline(const CameraOptions&, std::optional<double> field_rate);

  /// Whether a record belongs to this camera.
  bool wants(const wire::Record&) const noexcept;

  /// What is known before the first sample: the constants of the parameter, if any.
  CameraUpdate initial() const noexcept;

  /// Takes effect with the next sample.
  void set(const LiveOptions&) noexcept;

  /// Processes a sample for whose record wants() is true. `now` is the time of receipt on the steady clock, ns.
  [[nodiscard]] CameraUpdate process(const transport::Sample&, std::int64_t now) noexcept;
  /// The same in two steps, because fitting a lens takes longer than everything else: begin() returns an update without
  /// calibration, and calibrate() adds it if it is wanted and possible. Other samples may begin in between.
  [[nodiscard]] CameraUpdate begin(const transport::Sample&, std::int64_t now) noexcept;
  void calibrate(CameraUpdate&) noexcept;

  const CameraStatistics& statistics() const noexcept { return statistics_; }

 private:
  CameraUpdate begin(const wire::CameraConstants&, const transport::Sample&, std::int64_t now) noexcept;
  CameraUpdate begin(const wire::CameraParams&, const transport::Sample&, std::int64_t now) noexcept;
  void ignore(const transport::Sender&) noexcept;
  /// The followed sender changes; does nothing for the first sender.
  void note_failover() noexcept;
  bool is_new(const wire::CameraParams&, const transport::Sample&) noexcept;
  /// When a new sample was taken, according to options_.stamp.
  std::int64_t time_of(const transport::Sample&) noexcept;
  std::int64_t by_counter(const transport::Sample&) noexcept;
  std::optional<std::int64_t> stamp(std::int64_t time) noexcept;
  void add_lens(const camera::Converted&, CameraUpdate&) noexcept;
  camera::Result<camera::Calibration> calibration_of(const Uncalibrated&) noexcept;
  CameraUpdate drop(camera::CameraReason) noexcept;

  CameraOptions options_;
  SenderLock lock_;
  const bool finds_rate_;
  base::Sequence sequence_;
  CounterClock clock_;
  Stamper stamper_;
  camera::Converter converter_;
  camera::Calibrator calibrator_;
  CameraStatistics statistics_;
};

}  // namespace trk_bridge::bridge
