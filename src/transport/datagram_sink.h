// A sink made of an address and the encoder of a protocol.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "encoder.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::transport {

/// Where to send to: one address, a broadcast address or a multicast group.
struct SendSettings {
  std::string host;        ///< IPv6 without its brackets; a name is looked up at opening, IPv4 before IPv6
  std::uint16_t port = 0;  ///< 1 to 65535
  /// An address of this machine or an interface's name, for groups. Empty: the system's choice.
  std::string interface;
  std::optional<int> ttl;  ///< 0..255 (unicast and broadcast 1..255): how many routers it may pass, less one
  /// Seconds to 86400 after which constants are sent again with the next parameters of their id; 0: never.
  double constants_period = 1.0;
};

/// Sends from the thread that writes, and never blocks. Throws TransportError.
std::unique_ptr<Sink> open_datagram_sink(const SendSettings&, std::unique_ptr<Encoder>);

}  // namespace trk_bridge::transport
