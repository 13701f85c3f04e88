// One sender a camera: which of those that send records of one camera is followed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trk_bridge/transport/sample.h"

namespace trk_bridge::bridge {

/// The first sender holds the camera until it has been silent for the time of the constructor. Senders are told apart
/// by address and port; by address alone while one uses a new port for every datagram. Times are the steady clock's,
/// ns. Not synchronised, never allocates.
class SenderLock {
 public:
  /// With 0 every sender may follow every other.
  explicit SenderLock(std::chrono::nanoseconds failover) noexcept : failover_(failover.count()) {}

  /// What a sender may do.
  enum class Claim : std::uint8_t {
    holds,    ///< it is the one that is followed
    free,     ///< nobody holds the camera, or who did is silent: it is taken with take()
    foreign,  ///< another one holds the camera
  };
  Claim claim(const transport::Sender&, std::int64_t now) const noexcept;

  /// The sender holds the camera from now on, or goes on holding it.
  void take(const transport::Sender&, std::int64_t now) noexcept;
  /// A record of a sender whose claim was `foreign`.
  void note_foreign(const transport::Sender&) noexcept;

  /// Who holds the camera; none before the first one.
  const std::optional<transport::Sender>& holder() const noexcept { return holder_; }
  /// Whether ports say nothing, because one address came with `most_ports` different ones and none of them twice.
  bool ignores_ports() const noexcept { return ignores_ports_; }

  static constexpr std::size_t most_ports = 8;

 private:
  bool is_holder(const transport::Sender&) const noexcept;

  const std::int64_t failover_;
  std::optional<transport::Sender> holder_;
  std::int64_t last_heard_ = 0;
  bool ignores_ports_ = false;
  std::array<std::uint32_t, most_ports> ports_{};  // of the holder's address, since the holder was heard
  std::size_t port_count_ = 0;
};

}  // namespace trk_bridge::bridge
