// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One camera that is sent at an even rhythm, each time as it was one delay ago.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "camera_history.h"
#include "phase_lock.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// Delay and lead of one output of a camera.
struct OutputTiming {
  transport::Delay delay;
  std::int64_t lead = 0;  ///< ns
};

/// Of one output. Trivially copyable. Sums are over everything that was sent; differences of two reports give means.
struct DepartureStatistics {
  std::uint64_t sent = 0;
  std::int64_t last_sent = 0;    ///< steady clock, ns; valid once sent > 0
  std::int64_t last_time = 0;    ///< the time of what was sent, by the clock of the samples; 0: not known
  double age_sum = 0;            ///< ns: sum of the ages at departure
  std::uint64_t departures = 0;  ///< departures that were due while samples arrived
  std::uint64_t negative = 0;    ///< those of `departures` for which the newest samples were too old
  double margin_sum = 0;         ///< fields, sum over departures: how far the newest samples are ahead of the sent time
  std::uint64_t ignored = 0;     ///< ignored samples: duplicates and late ones by counter, although their time is new
};

/// Reads no clock: `now` is the steady clock, `clock` the clock of the samples' times, both in ns. If the samples'
/// times differ from that clock by more than 1 s, a sample counts as just taken, and later ones are placed relative to
/// it. Not synchronised. Does not allocate after construction.
class PacedCamera {
 public:
  /// A record for one output.
  struct Departure {
    wire::CameraParams params;
    std::int64_t time;  ///< by the clock of the samples
  };

  /// `rate`: see PhaseLock.
  PacedCamera(std::optional<double> rate, const std::vector<OutputTiming>& outputs);

  /// Adds a sample. `time` is its time (0: now), `lens_time` that of its lens (0: same as `time`). Older samples are
  /// discarded when times jump by more than 1 s, or when the format changes. A duplicate or late sample by counter is
  /// ignored if its time (an arrival) is new. Returns an error if the record cannot be interpolated: then only the
  /// rhythm is updated.
  camera::Result<void> add(const wire::CameraParams&, std::int64_t time, std::int64_t lens_time, std::int64_t now,
                           std::int64_t clock) noexcept;
  /// The constants changed: older samples are not interpolated with newer ones.
  void start_over() noexcept { history_.clear(); }

  /// When the next departure is due; none until that is known.
  std::optional<std::int64_t> due() const noexcept { return due_; }
  /// Call at a departure that is due. From then on take() may return a record, once for every output.
  void depart(std::int64_t now, std::int64_t clock) noexcept;
  /// Whether an output still waits for a record that was due: then a sample that arrives is sent now, not at the next
  /// departure.
  bool waits(std::int64_t now) const noexcept;
  /// The record to send now to an output; none if nothing is due, or if there is nothing newer than it was sent. The
  /// times of an output never go back, except when those of the samples go back by more than 1 s. The counter increases
  /// by one each time, from that of the first sample.
  std::optional<Departure> take(std::size_t output, std::int64_t now, std::int64_t clock) noexcept;

  /// From the next departure on. After an increase of the delay, nothing is sent until it is newer than what was sent
  /// last.
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
  wire::CameraParams newest_;  // received last
  std::vector<Output> outputs_;
  std::optional<std::int64_t> due_;
  std::int64_t departure_ = 0, arrival_ = 0;  // steady clock, of the last departure and arrival
  std::int64_t offset_ = 0;                   // from the samples' times to the clock
  std::optional<std::uint64_t> first_counter_;
  std::uint64_t ignored_ = 0;
};

}  // namespace trk_bridge::bridge
