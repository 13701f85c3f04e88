// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "params_ring.h"

#include <algorithm>

#include "trk_bridge/wire/fields.h"

namespace trk_bridge::c_api {

using base::Order;

void ParamsRing::push(const wire::CameraParams& params) noexcept {
  switch (sequence_.classify(params.counter, wire::fingerprint(params))) {
    case Order::first:
    case Order::restarted:
    case Order::uncounted:
      begin_with(params);
      break;
    case Order::next:
      // After a counter wraps, a new run begins.
      if (last_ && params.counter < given_) {
        begin_with(params);
      } else {
        insert(params);
      }
      break;
    case Order::late:
      if (!last_ || params.counter > given_) insert(params);
      break;
    case Order::duplicate:
      break;
  }
}

void ParamsRing::begin_with(const wire::CameraParams& params) noexcept {
  last_.reset();
  sets_[0] = params;
  size_ = 1;
}

void ParamsRing::insert(const wire::CameraParams& params) noexcept {
  if (size_ == capacity) {
    std::move(sets_.begin() + 1, sets_.end(), sets_.begin());
    --size_;
  }
  const auto end = sets_.begin() + size_;
  const auto place =
      std::upper_bound(sets_.begin(), end, params, [](const auto& a, const auto& b) { return a.counter < b.counter; });
  std::move_backward(place, end, end + 1);
  *place = params;
  ++size_;
}

/// Removes set `i` and all before it, and returns set `i`.
std::optional<wire::CameraParams> ParamsRing::pop(std::size_t i) noexcept {
  const wire::CameraParams taken = sets_[i];
  std::move(sets_.begin() + i + 1, sets_.begin() + size_, sets_.begin());
  size_ -= i + 1;
  last_ = given_ = taken.counter;
  return taken;
}

std::optional<wire::CameraParams> ParamsRing::pop_newest() noexcept {
  if (size_ == 0) return std::nullopt;
  return pop(size_ - 1);
}

std::optional<wire::CameraParams> ParamsRing::pop_oldest() noexcept {
  if (size_ == 0) return std::nullopt;
  return pop(0);
}

std::optional<wire::CameraParams> ParamsRing::pop_paced(std::uint64_t passed, std::uint64_t tolerated) noexcept {
  if (size_ == 0) return std::nullopt;
  const std::uint64_t newest = sets_[size_ - 1].counter;
  if (!last_ || size_ == capacity) return pop_newest();
  // As differences from the last one, because a sum may overflow.
  if (newest - *last_ > passed + tolerated) return pop_newest();
  const auto begin = sets_.begin(), end = begin + size_;
  const auto wanted = std::find_if(begin, end, [&](const auto& set) { return set.counter - *last_ >= passed; });
  if (wanted == end) return pop_newest();
  const std::uint64_t counted_to = *last_ + passed;
  auto taken = pop(static_cast<std::size_t>(wanted - begin));
  last_ = counted_to;
  return taken;
}

}  // namespace trk_bridge::c_api
