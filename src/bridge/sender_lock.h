// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Follows one sender per camera: decides which of several senders is used.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::bridge {

/// The first sender holds the camera until it has been silent for the failover time. Senders are distinguished by
/// address and port, or by address only while one uses a new port for every datagram. Times are of the steady clock,
/// ns. Not synchronised, does not allocate.
class SenderLock {
 public:
  /// With 0, any sender may replace any other at once.
  explicit SenderLock(std::chrono::nanoseconds failover) noexcept : failover_(failover.count()) {}

  /// What a sender may do.
  enum class Claim : std::uint8_t {
    holds,    ///< it is the followed sender
    free,     ///< no sender holds the camera, or its holder is silent; take() takes it
    foreign,  ///< another one holds the camera
  };
  Claim claim(const transport::Sender&, std::int64_t now) const noexcept;

  /// The sender holds the camera from now on.
  void take(const transport::Sender&, std::int64_t now) noexcept;
  /// Call for a record of a sender whose claim was `foreign`.
  void note_foreign(const transport::Sender&) noexcept;

  /// The sender that holds the camera; none before the first one.
  const std::optional<transport::Sender>& holder() const noexcept { return holder_; }
  /// Whether ports are ignored, because one address has sent from `most_ports` different ports and from none of them
  /// twice.
  bool ignores_ports() const noexcept { return ignores_ports_; }

  static constexpr std::size_t most_ports = 8;

 private:
  bool is_holder(const transport::Sender&) const noexcept;

  const std::int64_t failover_;
  std::optional<transport::Sender> holder_;
  std::int64_t last_heard_ = 0;
  bool ignores_ports_ = false;
  std::array<std::uint32_t, most_ports> ports_{};  // of the holder's address, since the last record of the holder
  std::size_t port_count_ = 0;
};

}  // namespace trk_bridge::bridge
