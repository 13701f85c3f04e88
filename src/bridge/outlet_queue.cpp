#include "outlet_queue.h"

#include <algorithm>
#include <variant>

#include "outlet_writer.h"

namespace trk_bridge::bridge {

OutletQueue::OutletQueue(std::size_t capacity, WhenFull when_full) : when_full_(when_full), ring_(capacity) {
  if (when_full == WhenFull::drop_oldest) kept_constants_.reserve(OutletWriter::most_ids);
}

Pushed OutletQueue::push(const wire::Record& record) {
  auto pushed = Pushed::queued;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (when_full_ == WhenFull::wait) has_room_.wait(lock, [this] { return closed_ || count_ < ring_.size(); });
    failed_ = failed_ || (when_full_ == WhenFull::fail && count_ == ring_.size());
    if (closed_ || failed_) {
      ++drops_;
      return Pushed::refused;
    }
    if (count_ == ring_.size()) pushed = make_room();
    ring_[(front_ + count_++) % ring_.size()] = record;
  }
  has_record_.notify_one();
  return pushed;
}

Pushed OutletQueue::make_room() {
  const auto oldest = take_front();
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

wire::Record OutletQueue::take_front() {
  const wire::Record record = ring_[front_];
  front_ = (front_ + 1) % ring_.size();
  --count_;
  return record;
}

std::optional<wire::Record> OutletQueue::pop() {
  std::unique_lock<std::mutex> lock(mutex_);
  has_record_.wait(lock, [this] { return closed_ || size() > 0; });
  if (size() == 0) return std::nullopt;
  if (!kept_constants_.empty()) {
    const wire::Record record = kept_constants_.front();
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

OutletQueueStatistics OutletQueue::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {size(), drops_, failed_};
}

}  // namespace trk_bridge::bridge
