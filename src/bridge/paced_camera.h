// One camera whose samples go out at an even rhythm, each as it is a delay before its departure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "camera_history.h"
#include "phase_lock.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// Of when one output of a camera is.
struct OutputTiming {
  transport::Delay delay;
  std::int64_t lead = 0;  ///< ns
};

/// Of one output. Trivially copyable. Sums are over what was sent; the difference of two looks gives means.
struct DepartureStatistics {
  std::uint64_t sent = 0;
  std::int64_t last_sent = 0;    ///< steady clock, ns; valid once sent > 0
  std::int64_t last_time = 0;    ///< what was sent is of this time, as its samples say it; 0: not known
  double age_sum = 0;            ///< ns: how long before its departure a camera was where it is sent
  std::uint64_t departures = 0;  ///< that were due while samples came
  std::uint64_t negative = 0;    ///< of them, those whose samples were not there yet: the newest were not new enough
  double margin_sum = 0;         ///< fields, over departures: how far the newest samples are ahead of what is sent
  std::uint64_t left_out = 0;    ///< samples: duplicates and late ones whose times say that they are new
};

/// Nothing here knows a clock: `now` is the steady clock, `clock` the one that samples' times are of, both in ns. Where
/// these times are more than 1 s off that clock, a sample counts as just taken, and the others by their distance.
/// Not synchronised. Allocates nothing after its construction.
class PacedCamera {
 public:
  /// A record for one output.
  struct Departure {
    wire::CameraParams params;
    std::int64_t time;  ///< as samples' times are
  };

  /// `rate` as in PhaseLock.
  PacedCamera(std::optional<double> rate, const std::vector<OutputTiming>& outputs);

  /// Takes a sample. `time` is when it was true, 0: now; `lens_time` likewise for its lens, 0: the same. What was
  /// before is forgotten when times jump by more than 1 s, and when the format is another one. A duplicate, or a late
  /// one by its counter, is left out where its time (an arrival) says that it is new. The error is why a
  /// record cannot be interpolated: nothing is changed by it but the rhythm.
  camera::Result<void> add(const wire::CameraParams&, std::int64_t time, std::int64_t lens_time, std::int64_t now,
                           std::int64_t clock) noexcept;
  /// The constants are others: what was before is not interpolated with what comes.
  void start_over() noexcept { history_.clear(); }

  /// When the next departure is due; none before that is known.
  std::optional<std::int64_t> due() const noexcept { return due_; }
  /// At a departure that is due, and from then on for every output, until it gives something.
  void depart(std::int64_t now, std::int64_t clock) noexcept;
  /// Whether an output has not got what was due: then a sample that arrives is for now, and not for the next departure.
  bool waits(std::int64_t now) const noexcept;
  /// What is to be sent now to an output; none where nothing is due, or nothing newer is there than it has got. The
  /// times of what an output gets never go back, but where the samples' do by more than 1 s. The counter goes up by one
  /// with each, from that of the first sample.
  std::optional<Departure> take(std::size_t output, std::int64_t now, std::int64_t clock) noexcept;

  /// From the next departure on. A longer delay holds an output until what is to be sent is newer than what it has got.
  void set_timing(std::size_t output, const OutputTiming& timing) noexcept { outputs_[output].timing = timing; }

  DepartureStatistics statistics(std::size_t output) const noexcept;
  const PhaseLock& rhythm() const noexcept { return rhythm_; }

 private:
  struct Output {
    OutputTiming timing;
    bool is_due = false;
    std::optional<PartTimes> last;
    std::uint64_t counted = 0;
    DepartureStatistics statistics;
  };

  PhaseLock rhythm_;
  base::Sequence order_{50, base::CounterUse::automatic};
  CameraHistory history_;
  wire::CameraParams newest_;  // the one that came last
  std::vector<Output> outputs_;
  std::optional<std::int64_t> due_;
  std::int64_t departure_ = 0, arrival_ = 0;  // steady clock, the last ones
  std::int64_t offset_ = 0;                   // from the samples' times to the clock
  std::optional<std::uint64_t> first_counter_;
  std::uint64_t left_out_ = 0;
};

}  // namespace trk_bridge::bridge
