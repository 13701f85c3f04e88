// IPv4 and IPv6 addresses as the kernel takes them.
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trk_bridge/transport/sender.h"

namespace trk_bridge::transport {

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = 0;

  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(&storage); }
  int family() const noexcept { return storage.ss_family; }
};

/// Every address that `host` (a name, an IPv4 or an IPv6 address, the latter with %ZONE where it needs one) stands for,
/// IPv4 before IPv6, never none. Throws TransportError with the host and the resolver's reason.
std::vector<SocketAddress> resolve(const std::string& host, std::uint16_t port);

/// An address written as numbers; none when it is not.
std::optional<SocketAddress> numeric_address(const std::string& text);

/// `::`, which takes IPv4 too when its socket does.
SocketAddress any_ipv6(std::uint16_t port) noexcept;
SocketAddress any_ipv4(std::uint16_t port) noexcept;

/// Mapped IPv4 addresses count as IPv4; `none` for other families.
Sender sender_of(const sockaddr_storage& address) noexcept;

bool is_any(const SocketAddress& address) noexcept;
bool is_multicast(const SocketAddress& address) noexcept;
/// Whether this machine's routes take it for a broadcast address.
bool is_broadcast(const SocketAddress& address) noexcept;

/// Where the socket is bound. Throws TransportError.
SocketAddress bound_address(int fd);

}  // namespace trk_bridge::transport
