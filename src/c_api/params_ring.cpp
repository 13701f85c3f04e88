#include "params_ring.h"

namespace trk_bridge::c_api {

void ParamsRing::push(const wire::CameraParams& params) noexcept {
  if (size_ == capacity) {
    first_ = (first_ + 1) % capacity;
    --size_;
  }
  sets_[(first_ + size_) % capacity] = params;
  ++size_;
}

/// Set `i`; it and all before it leave the ring.
wire::CameraParams ParamsRing::pop(std::size_t i) noexcept {
  const wire::CameraParams taken = at(i);
  first_ = (first_ + i + 1) % capacity;
  size_ -= i + 1;
  return taken;
}

bool ParamsRing::is_ascending() const noexcept {
  for (std::size_t i = 1; i < size_; ++i) {
    if (at(i).counter <= at(i - 1).counter) return false;
  }
  return true;
}

std::optional<wire::CameraParams> ParamsRing::pop_newest() noexcept {
  if (size_ == 0) return std::nullopt;
  const wire::CameraParams newest = pop(size_ - 1);
  last_ = newest.counter;
  return newest;
}

std::optional<wire::CameraParams> ParamsRing::pop_paced(std::uint64_t passed, std::uint64_t tolerated) noexcept {
  if (size_ == 0) return std::nullopt;
  const std::uint64_t newest = at(size_ - 1).counter;
  if (!last_ || newest <= *last_ || size_ == capacity || !is_ascending()) return pop_newest();
  // As differences from the last one, for a sum may be past what a counter holds.
  if (newest - *last_ > passed + tolerated) return pop_newest();
  for (std::size_t i = 0; i < size_; ++i) {
    if (at(i).counter < *last_ || at(i).counter - *last_ < passed) continue;
    *last_ += passed;
    return pop(i);
  }
  return pop_newest();
}

}  // namespace trk_bridge::c_api
