// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One nodelet per name at a time in a nodelet manager, also during unloading.
#pragma once

#include <chrono>
#include <string>

namespace trk_bridge::nodes {

/// Held by a nodelet as long as it exists. When a manager answers a request to unload, one of its worker threads may
/// still run a callback of the nodelet; that thread destroys the nodelet afterwards. Until then its ports and slots are
/// in use, and a new nodelet with its name could not start. Any thread.
class NodeletName {
 public:
  /// Waits until no other object holds the name. Throws std::runtime_error after `longest_wait`.
  explicit NodeletName(std::string name, std::chrono::milliseconds longest_wait = std::chrono::seconds(5));
  ~NodeletName();
  NodeletName(const NodeletName&) = delete;
  NodeletName& operator=(const NodeletName&) = delete;

 private:
  const std::string name_;
};

}  // namespace trk_bridge::nodes
