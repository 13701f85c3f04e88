// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A minimal relay in roscpp, with which the bridge is compared.
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <string>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <trk_bridge/CameraParams.h>

namespace trk_bridge::bench {

/// A UDP socket of the loopback interface.
class LoopbackSocket {
 public:
  /// Bound to `port`; 0: chosen by the kernel. Throws std::runtime_error.
  explicit LoopbackSocket(int port);
  ~LoopbackSocket();
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  int port() const;
  void send(const char* data, std::size_t size, int to_port) const;
  /// Waits for a datagram; 0 after close().
  std::size_t receive(char* data, std::size_t size) const;
  void close() const;

 private:
  int fd_;
};

/// trk from `~port` to params, camera_info and tf: no counters, stamps are the time of receipt, no lens fit, no
/// diagnostics. Messages are published by pointer.
class FloorIn {
 public:
  FloorIn(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name);
  ~FloorIn();

 private:
  void run();

  LoopbackSocket socket_;
  ::ros::Publisher params_, camera_info_, tf_;
  std::thread thread_;
};

/// params to trk, to `~port`.
class FloorOut {
 public:
  FloorOut(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name);

 private:
  void receive(const trk_bridge::CameraParams&) const;

  int port_;
  LoopbackSocket socket_;
  ::ros::Subscriber params_;
};

}  // namespace trk_bridge::bench
