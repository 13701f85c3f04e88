// Records on their way from the thread that has them to the one that writes them, bounded.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "trk_bridge/transport/sink.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// What becomes of a record when there is no room for it.
enum class WhenFull : std::uint8_t {
  drop_oldest,  ///< the oldest parameters make room; of constants, the newest of every id stay
  fail,         ///< the queue ends: it takes no record any more, those that it has stay
  wait,         ///< push() waits for room, for as long as may_wait() says
};

/// What became of a record that was pushed.
enum class Pushed : std::uint8_t {
  queued,
  made_room,       ///< queued, and older parameters dropped for it
  lost_constants,  ///< queued, and older constants dropped for it: those of OutletWriter::most_ids ids are kept
  refused,         ///< the queue has failed or is closed
};

/// One that is on its way.
struct QueuedRecord {
  wire::Record record;
  transport::RecordTime time;
};

/// What a queue holds and has lost. Trivially copyable.
struct OutletQueueStatistics {
  std::uint64_t queued = 0;  ///< records that wait now
  std::uint64_t drops = 0;   ///< records that were dropped or refused
  bool failed = false;       ///< with WhenFull::fail: it was full once
};

/// In order. One thread pushes, one pops; statistics() is for any. The lock is held for as long as it takes to copy a
/// record. Allocates when it is made, and never again.
class OutletQueue {
 public:
  /// `capacity` is in records, and more than 0. `may_wait` is for WhenFull::wait, and asked again and again.
  OutletQueue(std::size_t capacity, WhenFull, std::function<bool()> may_wait = {});

  [[nodiscard]] Pushed push(const wire::Record&, const transport::RecordTime& time = {});
  /// The oldest record; waits for one. None once the queue is closed and empty.
  [[nodiscard]] std::optional<QueuedRecord> pop();
  /// Likewise; none, too, when none has come for so long.
  [[nodiscard]] std::optional<QueuedRecord> pop(std::chrono::nanoseconds wait);
  /// From now on nothing is taken. What is queued can still be popped.
  void close();
  /// Closed and empty.
  bool is_over() const;

  OutletQueueStatistics statistics() const;

 private:
  std::size_t size() const noexcept { return kept_constants_.size() + count_; }
  QueuedRecord take_front();
  /// The oldest of what is queued, if anything is.
  std::optional<QueuedRecord> take(std::unique_lock<std::mutex>&);
  /// Room for one record, and what that cost.
  Pushed make_room();
  /// False where those of too many ids are kept.
  bool keep(const wire::CameraConstants&);

  const WhenFull when_full_;
  const std::function<bool()> may_wait_;
  mutable std::mutex mutex_;
  std::condition_variable has_record_, has_room_;
  std::vector<wire::CameraConstants> kept_constants_;  // the oldest first, all older than ring_, an id once
  std::vector<QueuedRecord> ring_;
  std::size_t front_ = 0, count_ = 0;  // of ring_
  std::uint64_t drops_ = 0;
  bool failed_ = false, closed_ = false;
};

}  // namespace trk_bridge::bridge
