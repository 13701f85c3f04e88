// What the kernel received and gave to no program.
#pragma once

#include <cstdint>

namespace trk_bridge::monitor {

/// Counts of this machine (of the calling thread's network namespace) since it was started; 0 where the kernel has
/// none.
struct KernelCounters {
  std::uint64_t unclaimed = 0;     ///< UDP datagrams to an address or port where no program listens
  std::uint64_t reverse_path = 0;  ///< packets discarded because the way back to their sender is another interface
};

/// Reads a few lines of /proc.
KernelCounters read_kernel_counters();

}  // namespace trk_bridge::monitor
