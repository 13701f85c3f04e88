#include "trk_bridge/base/sequence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace trk_bridge::base {

namespace {

constexpr double highest_rate = 1e6;

struct Step {
  bool ahead;
  std::uint64_t by;
};

// Two counters of at most 4 bytes are compared on the circle of 4-byte counters, so that a wrap is a step of one.
Step step_between(std::uint64_t from, std::uint64_t to) noexcept {
  constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
  if (from > largest || to > largest) return to > from ? Step{true, to - from} : Step{false, from - to};
  const std::uint64_t ahead = (to - from) & largest;
  return ahead <= largest / 2 ? Step{true, ahead} : Step{false, largest + 1 - ahead};
}

std::uint64_t checked_second(double field_rate) {
  if (!(field_rate > 0.0 && field_rate <= highest_rate)) {
    throw std::invalid_argument("field_rate = " + std::to_string(field_rate) +
                                ": allowed is more than 0 Hz and at most 1000000 Hz");
  }
  return static_cast<std::uint64_t>(std::max(1.0, std::round(field_rate)));
}

}  // namespace

Sequence::Sequence(double field_rate)
    : second_(checked_second(field_rate)),
      restart_ahead_(static_cast<std::uint64_t>(std::max(1.0, std::round(restart_ahead * field_rate)))) {}

Order Sequence::judge(std::uint64_t counter) noexcept {
  if (!newest_) {
    begin_at(counter);
    return Order::first;
  }
  const Step step = step_between(*newest_, counter);
  if (step.by == 0) {
    ++counts_.duplicates;
    return Order::duplicate;
  }
  return step.ahead ? judge_ahead(counter, step.by) : judge_back(counter, step.by);
}

void Sequence::begin_at(std::uint64_t counter) noexcept {
  newest_ = counter;
  span_ = 0;
  came_.reset();
  ++counts_.accepted;
}

Order Sequence::judge_ahead(std::uint64_t counter, std::uint64_t by) noexcept {
  if (by > restart_ahead_) {
    begin_at(counter);
    ++counts_.restarts;
    return Order::restarted;
  }
  newest_ = counter;
  span_ += by;
  if (by > window) {
    came_.reset();
  } else {
    came_ <<= by;
    came_.set(by - 1);
  }
  counts_.lost += by - 1;
  ++counts_.accepted;
  return Order::next;
}

Order Sequence::judge_back(std::uint64_t counter, std::uint64_t by) noexcept {
  if (by > second_) {
    begin_at(counter);
    ++counts_.restarts;
    return Order::restarted;
  }
  if (by <= window) {
    if (came_.test(by - 1)) {
      ++counts_.duplicates;
      return Order::duplicate;
    }
    came_.set(by - 1);
    // What is older than the first of this run was never counted as lost.
    if (by <= span_) --counts_.lost;
  }
  ++counts_.late;
  return Order::late;
}

}  // namespace trk_bridge::base
