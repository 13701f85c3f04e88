// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// How long a test waits.
#pragma once

#include <chrono>
#include <thread>

namespace trk_bridge::test {

/// How long an expected event may take. It only prevents waiting for ever: a test that passes does not wait that long,
/// also on a busy machine.
inline constexpr std::chrono::seconds deadline{60};

/// Polls `condition` until it is true or the deadline has passed; whether it became true. For events that cannot be
/// waited for.
template <typename Condition>
bool becomes_true(Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace trk_bridge::test
