// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What this process has read with system calls.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

namespace trk_bridge::test {

/// Bytes of all files and pipes, including those that this call reads.
inline std::int64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string key;
  std::int64_t value = 0;
  while (io >> key >> value) {
    if (key == "rchar:") return value;
  }
  throw std::runtime_error("/proc/self/io has no rchar");
}

}  // namespace trk_bridge::test
