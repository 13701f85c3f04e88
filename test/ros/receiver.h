// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// What a receiver of trk has received so far.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "udp.h"

namespace trk_bridge::test {

/// A port of the loopback.
class Receiver {
 public:
  std::string url() const { return "udp://127.0.0.1:" + std::to_string(socket_.port()); }

  /// Receives everything that has arrived. Throws if a datagram is no record.
  void take() {
    while (const auto bytes = socket_.receive(std::chrono::milliseconds(0))) {
      const auto read = wire::decode(*bytes, detector_);
      if (!read) throw std::runtime_error("no record: " + wire::describe(read.error()));
      if (const auto* p = std::get_if<wire::CameraParams>(&read->record)) params.push_back(*p);
      if (const auto* c = std::get_if<wire::CameraConstants>(&read->record)) constants.push_back(*c);
    }
  }
  /// Whether parameters with this counter are the last received ones.
  bool is_at(std::uint64_t counter) {
    take();
    return !params.empty() && params.back().counter == counter;
  }

  std::vector<wire::CameraParams> params;
  std::vector<wire::CameraConstants> constants;

 private:
  PlainSocket socket_;
  wire::LayoutDetector detector_;
};

}  // namespace trk_bridge::test
