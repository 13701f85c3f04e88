// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "outlet_queue.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "outlet_writer.h"

namespace trk_bridge::bridge {
namespace {

/// How often push() calls may_wait() while it waits for room.
constexpr std::chrono::milliseconds ask_period{50};

}  // namespace

OutletQueue::OutletQueue(std::size_t capacity, WhenFull when_full, std::function<bool()> may_wait)
    : when_full_(when_full), may_wait_(std::move(may_wait)), ring_(capacity) {
  if (when_full == WhenFull::drop_oldest) kept_constants_.reserve(OutletWriter::most_ids);
}

Pushed OutletQueue::push(const wire::Record& record, const transport::RecordTime& time) {
  auto pushed = Pushed::queued;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto is_full = [this] { return count_ == ring_.size(); };
    while (when_full_ == WhenFull::wait && !closed_ && is_full() && (!may_wait_ || may_wait_())) {
      has_room_.wait_for(lock, ask_period);
    }
    failed_ = failed_ || (when_full_ != WhenFull::drop_oldest && !closed_ && is_full());
    if (closed_ || failed_) {
      ++drops_;
      return Pushed::refused;
    }
    if (is_full()) pushed = make_room();
    ring_[(front_ + count_++) % ring_.size()] = {record, time};
  }
  has_record_.notify_one();
  return pushed;
}

Pushed OutletQueue::make_room() {
  const auto oldest = take_front().record;
  if (const auto* constants = std::get_if<wire::CameraConstants>(&oldest)) {
    if (keep(*constants)) return Pushed::queued;
    ++drops_;
    return Pushed::lost_constants;
  }
  ++drops_;
  return Pushed::made_room;
}

bool OutletQueue::keep(const wire::CameraConstants& constants) {
  const auto older = std::find_if(kept_constants_.begin(), kept_constants_.end(),
                                  [&](const auto& kept) { return kept.id == constants.id; });
  if (older != kept_constants_.end()) {
    kept_constants_.erase(older);
  } else if (kept_constants_.size() == OutletWriter::most_ids) {
    return false;
  }
  kept_constants_.push_back(constants);
  return true;
}

QueuedRecord OutletQueue::take_front() {
  const QueuedRecord record = ring_[front_];
  front_ = (front_ + 1) % ring_.size();
  --count_;
  return record;
}

std::optional<QueuedRecord> OutletQueue::pop() {
  std::unique_lock<std::mutex> lock(mutex_);
  has_record_.wait(lock, [this] { return closed_ || size() > 0; });
  return take(lock);
}

std::optional<QueuedRecord> OutletQueue::pop(std::chrono::nanoseconds wait) {
  std::unique_lock<std::mutex> lock(mutex_);
  has_record_.wait_for(lock, wait, [this] { return closed_ || size() > 0; });
  return take(lock);
}

std::optional<QueuedRecord> OutletQueue::take(std::unique_lock<std::mutex>& lock) {
  if (size() == 0) return std::nullopt;
  if (!kept_constants_.empty()) {
    const QueuedRecord record{kept_constants_.front(), {}};
    kept_constants_.erase(kept_constants_.begin());
    return record;
  }
  const auto record = take_front();
  lock.unlock();
  has_room_.notify_one();
  return record;
}

void OutletQueue::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  has_record_.notify_all();
  has_room_.notify_all();
}

bool OutletQueue::is_over() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return closed_ && size() == 0;
}

OutletQueueStatistics OutletQueue::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {size(), drops_, failed_};
}

}  // namespace trk_bridge::bridge
