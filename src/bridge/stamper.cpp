// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "stamper.h"

namespace trk_bridge::bridge {

std::optional<std::int64_t> Stamper::stamp(std::int64_t time) noexcept {
  // A time outside the range of ROS time must not affect later stamps.
  if (time < 0 || time > latest_stamp) return std::nullopt;
  const std::int64_t wanted = time - delay_;
  std::int64_t given = wanted;
  if (newest_ > 0 && given <= newest_) {
    if (newest_ - wanted > most_ahead) {
      last_step_ = newest_ - wanted;
      ++steps_;
    } else {
      given = newest_ + least_step;
      ++held_;
    }
  }
  if (!can_be_stamp(given)) return std::nullopt;
  newest_ = given;
  ahead_ = given - wanted;
  return given;
}

std::int64_t Stamper::unordered(std::int64_t time) const noexcept {
  if (time < 0 || time > latest_stamp) return 0;
  const std::int64_t wanted = time - delay_;
  return can_be_stamp(wanted) ? wanted : 0;
}

}  // namespace trk_bridge::bridge
