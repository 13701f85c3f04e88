// The clock of ages and rates, which nobody sets.
#pragma once

#include <chrono>
#include <cstdint>

namespace trk_bridge::nodes {

/// Nanoseconds.
inline std::int64_t steady_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace trk_bridge::nodes
