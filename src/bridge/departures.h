// When what comes goes out: at once, or at an even rhythm and of a delay before.
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

/// Where records go.
struct Destination {
  OutputTiming timing;
  /// Whether a timer sends, at an even rhythm. Always so where the timing is not 0.
  bool is_paced = false;
  /// Called in the thread of the timer where it is paced, else in the caller's. A
  /// time code is that of the record as it came; one that was interpolated has none.
  std::function<void(const wire::Record&, const transport::RecordTime&)> write;
  LossListener lose;  ///< records of too many ids, which are not sent
};

struct DepartureOptions {
  std::optional<double> rate;  ///< Hz, as in PhaseLock
  Feed feed = Feed::passed_on;
  /// The clock of the samples' times, ns. Any thread calls it.
  std::function<std::int64_t()> clock;
};

/// Destinations that are not paced get every record as it comes. The others are written by a thread with a timer of
/// absolute times of the steady clock (PacedCamera, one an id). Constants go to them at once, ahead of what is delayed;
/// when they change, what was before is not interpolated with what comes. So do parameters that cannot be interpolated:
/// what becomes of them is up to the destination.
///
/// write() is for one thread at a time, statistics() for any. Allocates only for an id that is new.
class Departures {
 public:
  /// Destinations are numbered as they are given.
  Departures(DepartureOptions, std::vector<Destination>);
  /// As finish().
  ~Departures();
  Departures(const Departures&) = delete;
  Departures& operator=(const Departures&) = delete;

  void write(const wire::CameraConstants&);
  /// `lens_time` is when the lens of the parameters was true, ns; 0: as `time`.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {}, std::int64_t lens_time = 0);
  void write(const OutgoingSet&);
  /// Changes when a destination's records are of, from the next departure on; false where no timer sends to it. Any
  /// thread.
  bool set_timing(std::size_t destination, const OutputTiming&);
  /// Sends what is still to come of the samples that it has, which takes the longest delay, and ends the timer.
  void finish();

  /// Of all ids together; none of a destination that is not paced.
  std::optional<DepartureStatistics> statistics(std::size_t destination) const;

 private:
  struct Camera {
    Camera(std::optional<double> rate, const std::vector<OutputTiming>& outputs) : paced(rate, outputs) {}

    PacedCamera paced;
    std::optional<wire::CameraConstants> constants, new_constants;
    std::optional<std::pair<wire::CameraParams, std::int64_t>> as_it_came;
  };
  struct Ready {
    std::size_t output;
    wire::Record record;
    std::int64_t time;
  };

  Camera* camera_of(std::uint32_t id);
  void run();
  /// Puts what is to be written now into ready_.
  void collect(std::int64_t now);
  void collect(Camera&, std::int64_t now);
  std::optional<std::int64_t> next_due() const;

  const DepartureOptions options_;
  const std::vector<Destination> destinations_;
  std::vector<std::size_t> paced_;  // numbers of destinations

  mutable std::mutex mutex_;  // of what follows
  std::vector<OutputTiming> timings_;
  std::condition_variable changed_;
  bool wakes_ = false;
  std::optional<std::int64_t> end_;  // steady clock
  std::map<std::uint32_t, Camera> cameras_;

  std::vector<Ready> ready_;  // of the thread
  std::thread thread_;
};

}  // namespace trk_bridge::bridge
