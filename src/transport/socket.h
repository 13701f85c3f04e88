// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Descriptors, addresses and options of sockets.
#pragma once

#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/system_text.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

class Descriptor {
 public:
  Descriptor() = default;
  /// Owns the result of a system call; a negative number is none.
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      close();
      fd_ = std::exchange(other.fd_, -1);
    }
    return *this;
  }

  int get() const noexcept { return fd_; }
  bool is_open() const noexcept { return fd_ >= 0; }
  void close() noexcept {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_ = -1;
};

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = 0;

  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(&storage); }
  int family() const noexcept { return storage.ss_family; }
};

/// All addresses of `host` (a name, an IPv4 address, or an IPv6 address with %ZONE if necessary), IPv4 before IPv6, at
/// least one, without zones. Throws TransportError with the host and the reason of the resolver.
std::vector<SocketAddress> resolve(const std::string& host, std::uint16_t port);

/// The name of the interface in an IPv6 address with %ZONE; empty for every other host.
std::string zone_of(const std::string& host);

/// A numeric address, without its zone; none for other texts.
std::optional<SocketAddress> numeric_address(const std::string& text);

/// `::`, which includes IPv4 if the socket allows it.
SocketAddress any_ipv6(std::uint16_t port) noexcept;
SocketAddress any_ipv4(std::uint16_t port) noexcept;

/// Mapped IPv4 addresses become IPv4; `none` for other families.
Sender sender_of(const sockaddr_storage& address) noexcept;

bool is_any(const SocketAddress& address) noexcept;
bool is_multicast(const SocketAddress& address) noexcept;
/// Whether the address exists on each interface separately (link-local, or an interface-local group), so that its
/// socket is permanently bound to one interface.
bool needs_zone(const SocketAddress& address) noexcept;
/// The index of its interface; 0: none given.
unsigned zone_index(const SocketAddress& address) noexcept;
void set_zone(SocketAddress& ipv6, unsigned interface_index) noexcept;
void set_port(SocketAddress& address, std::uint16_t port) noexcept;
/// Whether a socket can be bound to it now: an interface that is up has it, or it means several addresses of this
/// machine.
bool is_local(SocketAddress address) noexcept;
/// Whether it is a broadcast address by the routes of this machine.
bool is_broadcast(const SocketAddress& address) noexcept;

/// The address that the socket is bound to. Throws TransportError.
SocketAddress bound_address(int fd);

/// Throws TransportError: "`what`: the system refused: …".
template <typename T>
void set_option(int fd, int level, int option, const T& value, const char* what) {
  if (::setsockopt(fd, level, option, &value, sizeof value) == 0) return;
  throw TransportError(std::string(what) + ": the system refused: " + base::system_text(errno));
}

}  // namespace trk_bridge::transport
