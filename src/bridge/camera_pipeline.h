// One camera's way in: its senders and records judged, converted, stamped and calibrated.
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

/// What the last stamp was made of, and why it was not what is wanted.
enum class StampState : std::uint8_t {
  arrival,
  learning,    ///< arrival: the counter's rhythm is not learned yet, or it has none
  no_counter,  ///< arrival: the protocol has none
  uncounted,   ///< arrival: the counter does not count
  counter,
  no_source_time,  ///< arrival: the record has no time of the sender's own
  source,
};

/// What became of a camera's records so far. Trivially copyable. "New" are those that base::Sequence takes for new, and
/// all of protocols without a counter.
struct CameraStatistics {
  std::uint64_t params = 0;               ///< parameter records of the sender that is followed, of any order
  base::SequenceCounts sequence;          ///< `accepted` counts all new ones
  std::uint64_t without_counter = 0;      ///< of the new ones, those of a protocol without a counter
  std::uint64_t without_lens = 0;         ///< likewise without a lens: of these only the pose is published
  std::uint64_t dropped = 0;              ///< new ones not published at all; `drop_reason` is why the last one was not
  std::uint64_t unstampable = 0;          ///< of these, those whose time is outside of ROS time
  std::uint64_t withheld = 0;             ///< params not published although tf was; `withhold_reason`
  std::uint64_t without_camera_info = 0;  ///< new ones without a CameraInfo although it is wanted; `info_reason`
  std::uint64_t bad_constants = 0;        ///< constants that leave no picture: ignored
  std::uint64_t id_changes = 0;           ///< how often a record had another id than the one before
  std::uint64_t foreign = 0;              ///< records of other senders than `sender`: ignored; `foreign_sender`
  std::uint64_t failovers = 0;            ///< how often another sender was followed; the one before: `silent_sender`
  StampState stamp_state{};
  CounterClockStatistics rhythm;              ///< of the counter, whatever stamps are made of
  std::optional<std::int64_t> source_behind;  ///< ns, arrival less the sender's own time, of the last one that has one
  std::uint64_t held_stamps = 0;              ///< see Stamper
  std::int64_t stamp_ahead = 0;               ///< ns, see Stamper
  std::uint64_t clock_steps = 0;              ///< see Stamper
  std::int64_t clock_step = 0;                ///< ns, see Stamper
  std::uint32_t last_id = 0;
  std::uint32_t last_format = 0;  ///< as received
  ConstantsOrigin constants = ConstantsOrigin::none;
  camera::CameraReason drop_reason{}, withhold_reason{}, info_reason{};
  bool has_lens = true;                             ///< the last new one had one
  bool has_camera_info = false;                     ///< the last published one had one
  double fit_residual = 0;                          ///< pixels, of the last CameraInfo
  bool ignores_ports = false;                       ///< see SenderLock
  transport::Sender foreign_sender, silent_sender;  ///< valid once foreign > 0, failovers > 0
  transport::Sender sender;                         ///< of the last new one, as are those below
  const char* encoding = "";                        ///< transport::Sample::origin
  std::int64_t last_new = 0;                        ///< steady clock, ns; valid once sequence.accepted > 0
};

/// What a calibration is made of.
struct Uncalibrated {
  camera::Result<camera::Lens> lens;
  std::optional<wire::CameraConstants> constants;  ///< as received
};

/// What the encoders of a camera's lens counted.
struct CameraEncoders {
  std::uint32_t id = 0;
  transport::LensEncoders counts;
};

/// What one sample gives to publish, all of one stamp.
struct CameraUpdate {
  std::int64_t stamp = 0;                          ///< ns since 1970 UTC; 0: no time is known (of constants alone)
  std::optional<wire::CameraConstants> constants;  ///< they changed; they go with params in the published format
  std::optional<wire::CameraParams> params;        ///< in the published format
  std::optional<camera::Calibration> calibration;  ///< of CameraInfo
  std::optional<Eigen::Isometry3d> pose;           ///< studio_T_camera, m
  std::optional<base::CountedTimeCode> time_code;  ///< of parameters, where the protocol has one
  std::optional<CameraEncoders> encoders;          ///< likewise
  std::optional<Uncalibrated> uncalibrated;        ///< a calibration is wanted: CameraPipeline::calibrate() makes it

  bool is_empty() const noexcept { return stamp == 0 && !constants; }
};

/// Not synchronised: one thread at a time. Never allocates.
class CameraPipeline {
 public:
  /// `field_rate` in Hz, see base::Sequence; none: it is found.
  CameraPipeline(const CameraOptions&, std::optional<double> field_rate);

  /// Whether a record is this camera's.
  bool wants(const wire::Record&) const noexcept;

  /// What is known before the first sample: constants of the parameter where there are any.
  CameraUpdate initial() const noexcept;

  /// From the next sample on.
  void set(const LiveOptions&) noexcept;

  /// Takes a sample whose record wants() is true for. `now` is the steady clock's time of receipt, ns.
  [[nodiscard]] CameraUpdate process(const transport::Sample&, std::int64_t now) noexcept;
  /// The same in two steps, because fitting a lens takes longer than all the rest: an update without calibration, which
  /// calibrate() adds where one is wanted and can be made. Between them other samples may begin.
  [[nodiscard]] CameraUpdate begin(const transport::Sample&, std::int64_t now) noexcept;
  void calibrate(CameraUpdate&) noexcept;

  const CameraStatistics& statistics() const noexcept { return statistics_; }

 private:
  CameraUpdate begin(const wire::CameraConstants&, const transport::Sample&, std::int64_t now) noexcept;
  CameraUpdate begin(const wire::CameraParams&, const transport::Sample&, std::int64_t now) noexcept;
  void ignore(const transport::Sender&) noexcept;
  /// Another sender than the one before, if there was one, is followed from now on.
  void note_failover() noexcept;
  bool is_new(const wire::CameraParams&, const transport::Sample&) noexcept;
  /// When a new sample was taken, as far as options_.stamp says how.
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
