// Records on their way from the thread that has them to the one that writes them, bounded.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::bridge {

/// What becomes of a record when there is no room for it.
enum class WhenFull : std::uint8_t {
  drop_oldest,  ///< the oldest parameters make room; of constants, the newest of every id stay
  fail,         ///< the queue ends: it takes no record any more, those that it has stay
  wait,         ///< push() waits for room
};

/// What became of a record that was pushed.
enum class Pushed : std::uint8_t {
  queued,
  made_room,       ///< queued, and older parameters dropped for it
  lost_constants,  ///< queued, and older constants dropped for it: those of OutletWriter::most_ids ids are kept
  refused,         ///< the queue has failed or is closed
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
  /// `capacity` is in records, and more than 0.
  OutletQueue(std::size_t capacity, WhenFull);

  [[nodiscard]] Pushed push(const wire::Record&);
  /// The oldest record; waits for one. None once the queue is closed and empty.
  [[nodiscard]] std::optional<wire::Record> pop();
  /// From now on nothing is taken. What is queued can still be popped.
  void close();

  OutletQueueStatistics statistics() const;

 private:
  std::size_t size() const noexcept { return kept_constants_.size() + count_; }
  wire::Record take_front();
  /// Room for one record, and what that cost.
  Pushed make_room();
  /// False where those of too many ids are kept.
  bool keep(const wire::CameraConstants&);

  const WhenFull when_full_;
  mutable std::mutex mutex_;
  std::condition_variable has_record_, has_room_;
  std::vector<wire::CameraConstants> kept_constants_;  // the oldest first, all older than ring_, an id once
  std::vector<wire::Record> ring_;
  std::size_t front_ = 0, count_ = 0;  // of ring_
  std::uint64_t drops_ = 0;
  bool failed_ = false, closed_ = false;
};

}  // namespace trk_bridge::bridge
