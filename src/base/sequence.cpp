// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/base/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "number_text.h"

namespace trk_bridge::base {

namespace {

constexpr double highest_rate = 1e6;

struct Step {
  bool ahead;
  std::uint64_t by;
};

// Counters with fewer than 64 bits, which continue at 0 after the largest value.
constexpr std::array<unsigned, 3> short_counters{16, 31, 32};

/// Whether a counter of `size` values has wrapped from `from` to `to`, both within `window` of its end.
constexpr bool wraps(std::uint64_t from, std::uint64_t to, std::uint64_t size) noexcept {
  return from < size && from >= size - Sequence::window && to < Sequence::window;
}

Step step_between(std::uint64_t from, std::uint64_t to) noexcept {
  for (const unsigned bits : short_counters) {
    const std::uint64_t size = std::uint64_t{1} << bits;
    if (wraps(from, to, size)) return {true, size - from + to};
    if (wraps(to, from, size)) return {false, size - to + from};
  }
  const std::uint64_t ahead = to - from;
  constexpr std::uint64_t half = std::uint64_t{1} << 63U;
  return ahead < half ? Step{true, ahead} : Step{false, from - to};
}

bool is_rate(double field_rate) noexcept { return field_rate > 0.0 && field_rate <= highest_rate; }

std::uint64_t at_least_one(double counts) noexcept {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(counts)));
}

double checked(double field_rate) {
  if (!is_rate(field_rate)) {
    throw std::invalid_argument("field_rate = " + number_text(field_rate) +
                                ": allowed is more than 0 Hz and at most 1000000 Hz");
  }
  return field_rate;
}

/// The longest cycle in counts: a counter that goes back by less, twice within as many records, is cyclic. At least
/// 128, so that a second at 60 Hz is a cycle even if the field rate is 25.
std::uint64_t longest_cycle(std::uint64_t second) noexcept {
  constexpr std::uint64_t least = 128;
  return std::max(least, 2 * second);
}

}  // namespace

Sequence::Sequence(double field_rate, CounterUse use)
    : use_(use),
      second_(at_least_one(checked(field_rate))),
      restart_ahead_(at_least_one(restart_ahead * field_rate)),
      since_backward_jump_(longest_cycle(second_)) {
  if (use == CounterUse::ignore) counts_.state = CounterState::ignored;
}

void Sequence::use_field_rate(double field_rate) noexcept {
  if (!is_rate(field_rate)) return;
  second_ = at_least_one(field_rate);
  restart_ahead_ = at_least_one(restart_ahead * field_rate);
}

Order Sequence::classify(std::uint64_t counter, std::uint64_t fingerprint) noexcept {
  step_ = 0;
  Order order = use_ == CounterUse::ignore ? Order::uncounted : order_of(counter, fingerprint);
  if (use_ == CounterUse::automatic) {
    update_state(order);
    if (order != Order::duplicate) {
      fingerprints_[next_fingerprint_] = fingerprint;
      next_fingerprint_ = (next_fingerprint_ + 1) % static_cast<std::size_t>(std::min<std::uint64_t>(second_, window));
    }
    if (counts_.state == CounterState::frozen && !is_new(order)) order = Order::uncounted;
  }
  switch (order) {
    case Order::duplicate:
      ++counts_.duplicates;
      break;
    case Order::late:
      ++counts_.late;
      break;
    case Order::restarted:
      ++counts_.restarts;
      [[fallthrough]];
    default:
      ++counts_.accepted;
  }
  return order;
}

Order Sequence::order_of(std::uint64_t counter, std::uint64_t fingerprint) noexcept {
  if (!newest_) return begin_at(counter, Order::first);
  const Step step = step_between(*newest_, counter);
  return step.ahead && step.by > 0 ? ahead(counter, step.by) : back(counter, step.by, fingerprint);
}

Order Sequence::begin_at(std::uint64_t counter, Order verdict) noexcept {
  newest_ = counter;
  span_ = 0;
  received_.reset();
  return verdict;
}

Order Sequence::ahead(std::uint64_t counter, std::uint64_t by) noexcept {
  if (by > restart_ahead_) return begin_at(counter, Order::restarted);
  newest_ = counter;
  step_ = by;
  span_ += by;
  if (by > window) {
    received_.reset();
  } else {
    received_ <<= bit_of(by) + 1;
    received_.set(bit_of(by));
  }
  counts_.lost += by - 1;
  return Order::next;
}

Order Sequence::back(std::uint64_t counter, std::uint64_t by, std::uint64_t fingerprint) noexcept {
  if (use_ == CounterUse::strict) {
    if (by > second_) return begin_at(counter, Order::restarted);
    return received(by) ? Order::duplicate : fill(by);
  }
  if (is_known(fingerprint)) return Order::duplicate;
  if (by == 0) {
    note_backward_jump(CounterState::frozen);
    return Order::uncounted;
  }
  if (by <= late_reach && !received(by) && lates_ < lates_allowed) return fill(by);
  if (by < longest_cycle(second_)) note_backward_jump(CounterState::cycles);
  return begin_at(counter, Order::restarted);
}

void Sequence::note_backward_jump(CounterState state) noexcept {
  if (since_backward_jump_ < longest_cycle(second_)) counts_.state = std::max(counts_.state, state);
  since_backward_jump_ = 0;
}

Order Sequence::fill(std::uint64_t by) noexcept {
  if (by <= window) {
    received_.set(bit_of(by));
    // Counters before the first one of this run were never counted as lost.
    if (by <= span_) --counts_.lost;
  }
  return Order::late;
}

bool Sequence::is_known(std::uint64_t fingerprint) const noexcept {
  return std::find(fingerprints_.begin(), fingerprints_.end(), fingerprint) != fingerprints_.end();
}

void Sequence::update_state(Order order) noexcept {
  repeats_ = order == Order::duplicate ? repeats_ + 1 : 0;
  lates_ = order == Order::late ? lates_ + 1 : 0;
  steady_ = order == Order::next ? steady_ + 1 : 0;
  if (since_backward_jump_ < longest_cycle(second_)) ++since_backward_jump_;
  if (repeats_ > repeats_allowed) counts_.state = CounterState::frozen;
  if (steady_ > longest_cycle(second_)) counts_.state = CounterState::counts;
}

}  // namespace trk_bridge::base
