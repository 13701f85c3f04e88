// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The two clocks, in nanoseconds.
#pragma once

#include <chrono>
#include <cstdint>

namespace trk_bridge::base {

/// For durations and rates: nanoseconds of a monotonic clock.
inline std::int64_t steady_now() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// For stamps: nanoseconds since 1970 UTC, by the system clock.
inline std::int64_t wall_now() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace trk_bridge::base
