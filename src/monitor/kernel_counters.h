// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Packets that the kernel received but delivered to no program.
#pragma once

#include <cstdint>

namespace trk_bridge::monitor {

/// Counters of this machine (of the network namespace of the calling thread) since it was started; 0 if the kernel has
/// none.
struct KernelCounters {
  std::uint64_t unclaimed = 0;     ///< UDP datagrams to an address or port where no program listens
  std::uint64_t reverse_path = 0;  ///< packets discarded because the route back to their sender uses another interface
};

/// Reads a few lines of /proc.
KernelCounters read_kernel_counters();

}  // namespace trk_bridge::monitor
