// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A bounded queue of records between the thread that produces them and the thread that writes them.
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

/// What happens when the queue is full.
enum class WhenFull : std::uint8_t {
  drop_oldest,  ///< drops the oldest parameters; keeps the newest constants of every id
  fail,         ///< the queue accepts no more records; those in it stay
  wait,         ///< push() waits for room while may_wait() returns true
};

/// The result of a push.
enum class Pushed : std::uint8_t {
  queued,
  made_room,       ///< queued; older parameters were dropped for it
  lost_constants,  ///< queued; older constants were dropped for it, because constants of OutletWriter::most_ids ids are
                   ///< kept already
  refused,         ///< the queue has failed or is closed
};

struct QueuedRecord {
  wire::Record record;
  transport::RecordTime time;
};

/// Trivially copyable.
struct OutletQueueStatistics {
  std::uint64_t queued = 0;  ///< records in the queue now
  std::uint64_t drops = 0;   ///< records that were dropped or refused
  bool failed = false;       ///< with WhenFull::fail: it has been full
};

/// Keeps the order. One thread pushes, one pops; any thread may call statistics(). The lock is held only while a record
/// is copied. Allocates only in the constructor.
class OutletQueue {
 public:
  /// `capacity` is in records, and more than 0. `may_wait` is for WhenFull::wait; it is called repeatedly.
  OutletQueue(std::size_t capacity, WhenFull, std::function<bool()> may_wait = {});

  [[nodiscard]] Pushed push(const wire::Record&, const transport::RecordTime& time = {});
  /// The oldest record; waits for one. None once the queue is closed and empty.
  [[nodiscard]] std::optional<QueuedRecord> pop();
  /// The same with a timeout: none if no record arrives within `wait`.
  [[nodiscard]] std::optional<QueuedRecord> pop(std::chrono::nanoseconds wait);
  /// Accepts no more records. Queued records can still be popped.
  void close();
  /// Closed and empty.
  bool is_over() const;

  OutletQueueStatistics statistics() const;

 private:
  std::size_t size() const noexcept { return kept_constants_.size() + count_; }
  QueuedRecord take_front();
  /// The oldest queued record, if any.
  std::optional<QueuedRecord> take(std::unique_lock<std::mutex>&);
  /// Makes room for one record; returns what was dropped for it.
  Pushed make_room();
  /// False if constants of too many ids are kept already.
  bool keep(const wire::CameraConstants&);

  const WhenFull when_full_;
  const std::function<bool()> may_wait_;
  mutable std::mutex mutex_;
  std::condition_variable has_record_, has_room_;
  std::vector<wire::CameraConstants> kept_constants_;  // oldest first, all older than ring_, each id once
  std::vector<QueuedRecord> ring_;
  std::size_t front_ = 0, count_ = 0;  // of ring_
  std::uint64_t drops_ = 0;
  bool failed_ = false, closed_ = false;
};

}  // namespace trk_bridge::bridge
