// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Checks periodically whether the ROS master still knows this node.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "bridge/ros_report.h"

namespace trk_bridge::nodes {

/// A restarted master has lost all registrations of nodes, and roscpp does not register again. Asks from its own
/// thread, from construction to destruction; destruction does not wait for an answer.
class MasterWatch {
 public:
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// Any thread, here and below. `forgot` is final.
  bridge::MasterState state() const noexcept { return state_; }
  /// When the master last answered, steady clock, ns; 0: never.
  std::int64_t answered() const noexcept { return answered_; }

 private:
  void run();
  /// Whether the master knows this node; none if it does not answer.
  std::optional<bool> ask();

  std::atomic<bridge::MasterState> state_{bridge::MasterState::unasked};
  std::atomic<std::int64_t> answered_{0};
  std::mutex mutex_;
  std::condition_variable stop_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace trk_bridge::nodes
