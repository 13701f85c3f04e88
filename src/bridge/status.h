// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The diagnostic status of one thing: that of REP 107, without ROS.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace trk_bridge::bridge {

/// With the numbers of diagnostic_msgs/DiagnosticStatus.
enum class Level : std::uint8_t { ok = 0, warn = 1, error = 2, stale = 3 };

/// A summary and key-value pairs in display order.
struct Status {
  Level level = Level::ok;
  std::string message;
  std::string hardware_id;
  std::vector<std::pair<std::string, std::string>> values;

  void add(std::string key, std::string value) { values.emplace_back(std::move(key), std::move(value)); }
  template <typename Count, typename = std::enable_if_t<std::is_integral_v<Count>>>
  void add(std::string key, Count count) {
    values.emplace_back(std::move(key), std::to_string(count));
  }
};

}  // namespace trk_bridge::bridge
