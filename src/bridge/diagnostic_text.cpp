// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "diagnostic_text.h"

#include "base/number_text.h"

namespace trk_bridge::bridge {

std::string duration_text(double seconds) { return base::fixed_text(seconds, 1) + " s"; }

std::string two_decimals(double value) { return base::fixed_text(value, 2); }

std::string pixels_text(double pixels) { return base::fixed_text(pixels, 3); }

std::string age_text(bool ever, std::int64_t then, std::int64_t now) {
  return ever ? two_decimals(seconds_between(then, now)) : std::string("never");
}

const char* constants_text(ConstantsOrigin origin) noexcept {
  switch (origin) {
    case ConstantsOrigin::none:
      return "no";
    case ConstantsOrigin::parameter:
      return "from the parameter";
    case ConstantsOrigin::any_camera:
      return "received with id 0";
    case ConstantsOrigin::own:
      return "received";
  }
  return "no";
}

double seconds_between(std::int64_t from, std::int64_t to) noexcept {
  constexpr double nanoseconds_per_second = 1e9;
  return static_cast<double>(to - from) / nanoseconds_per_second;
}

double rate_between(std::uint64_t events_before, std::uint64_t events_now, std::int64_t from,
                    std::int64_t to) noexcept {
  const double seconds = seconds_between(from, to);
  return seconds <= 0 ? 0 : static_cast<double>(events_now - events_before) / seconds;
}

}  // namespace trk_bridge::bridge
