// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Decides when records are sent: at once, or by a timer at an even rhythm and with a delay.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "outgoing_set.h"
#include "outlet_writer.h"
#include "paced_camera.h"

namespace trk_bridge::bridge {

inline OutputTiming timing_of(const transport::SinkForm& form) noexcept {
  return {form.delay.value_or(transport::Delay{}), form.lead.value_or(0)};
}

/// A receiver of records.
struct Destination {
  OutputTiming timing;
  /// Whether a timer sends at an even rhythm. Always true if the timing is not 0.
  bool is_paced = false;
  /// Called in the thread of the timer if it is paced, else in the caller's. The time code is that of the original
  /// record; an interpolated record has none.
  std::function<void(const wire::Record&, const transport::RecordTime&)> write;
  LossListener lose;  ///< called for records that are not sent because there are too many ids
};

struct DepartureOptions {
  std::optional<double> rate;  ///< Hz, as in PhaseLock
  Feed feed = Feed::passed_on;
  /// The clock of the samples' times, ns. Called by any thread.
  std::function<std::int64_t()> clock;
};

/// Destinations that are not paced get every record when it arrives. The others are written by a thread with a timer
/// (absolute times of the steady clock; one PacedCamera per id). Constants are sent to them at once, before delayed
/// records; after a change of constants, older samples are not interpolated with newer ones. Parameters that cannot be
/// interpolated are also passed on at once: the destination decides what to do with them.
///
/// write() may be called by one thread at a time, statistics() by any. Allocates only for a new id.
class Departures {
 public:
  /// Destinations are numbered in the given order.
  Departures(DepartureOptions, std::vector<Destination>);
  /// Calls finish().
  ~Departures();
  Departures(const Departures&) = delete;
  Departures& operator=(const Departures&) = delete;

  void write(const wire::CameraConstants&);
  /// `lens_time` is the time of the lens in the parameters, ns; 0: same as `time`.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {}, std::int64_t lens_time = 0);
  void write(const OutgoingSet&);
  /// Changes the delay and lead of a destination, from the next departure on; false if no timer sends to it. Any
  /// thread.
  bool set_timing(std::size_t destination, const OutputTiming&);
  /// Sends what is still delayed, which takes as long as the longest delay, and ends the timer.
  void finish();

  /// Sum over all ids; none if the destination is not paced.
  std::optional<DepartureStatistics> statistics(std::size_t destination) const;

 private:
  struct Camera {
    Camera(std::optional<double> rate, const std::vector<OutputTiming>& outputs) : paced(rate, outputs) {}

    PacedCamera paced;
    std::optional<wire::CameraConstants> constants, new_constants;
    std::optional<std::pair<wire::CameraParams, std::int64_t>> unchanged;
  };
  struct Ready {
    std::size_t output;
    wire::Record record;
    std::int64_t time;
  };

  Camera* camera_of(std::uint32_t id);
  void run();
  /// Puts the records that are due into ready_.
  void collect(std::int64_t now);
  void collect(Camera&, std::int64_t now);
  std::optional<std::int64_t> next_due() const;

  const DepartureOptions options_;
  const std::vector<Destination> destinations_;
  std::vector<std::size_t> paced_;  // indices of destinations

  mutable std::mutex mutex_;  // of what follows
  std::vector<OutputTiming> timings_;
  std::condition_variable changed_;
  bool wakes_ = false;
  std::optional<std::int64_t> end_;  // steady clock
  std::map<std::uint32_t, Camera> cameras_;

  std::vector<Ready> ready_;  // used by the thread only
  std::thread thread_;
};

}  // namespace trk_bridge::bridge
