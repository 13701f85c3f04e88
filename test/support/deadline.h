// How long a test waits.
#pragma once

#include <chrono>
#include <thread>

namespace trk_bridge::test {

/// How long anything that has to happen may take. It only guards against waiting for ever: no test that passes waits as
/// long, also on a machine that is busy with other things.
inline constexpr std::chrono::seconds deadline{60};

/// Asks `condition` again and again until it is true or the deadline has passed; whether it became true. For what gives
/// no sign of its own.
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
