// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "kernel_counters.h"

#include <fstream>
#include <sstream>
#include <string>

namespace trk_bridge::monitor {
namespace {

/// A counter in a file with pairs of lines: `group: name name …`, then `group: number number …`.
std::uint64_t counter_in(const char* path, const std::string& group, const std::string& name) {
  std::ifstream file(path);
  std::string names, numbers;
  while (std::getline(file, names) && std::getline(file, numbers)) {
    std::istringstream heads(names), values(numbers);
    std::string head, value;
    if (!(heads >> head) || head != group || !(values >> value)) continue;
    while (heads >> head && values >> value) {
      if (head == name) return std::stoull(value);
    }
  }
  return 0;
}

/// A counter in a file with lines `name number`.
std::uint64_t counter_in(const char* path, const std::string& name) {
  std::ifstream file(path);
  std::string head;
  std::uint64_t value = 0;
  while (file >> head >> value) {
    if (head == name) return value;
  }
  return 0;
}

}  // namespace

KernelCounters read_kernel_counters() {
  return {counter_in("/proc/thread-self/net/snmp", "Udp:", "NoPorts") +
              counter_in("/proc/thread-self/net/snmp6", "Udp6NoPorts"),
          counter_in("/proc/thread-self/net/netstat", "TcpExt:", "IPReversePathFilter")};
}

}  // namespace trk_bridge::monitor
