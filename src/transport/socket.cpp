// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "socket.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include "base/system_text.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

template <typename T>
T as(const sockaddr_storage& storage) noexcept {
  static_assert(sizeof(T) <= sizeof(sockaddr_storage));
  T address;
  std::memcpy(&address, &storage, sizeof address);
  return address;
}

template <typename T>
SocketAddress from(const T& address) noexcept {
  SocketAddress to;
  std::memcpy(&to.storage, &address, sizeof address);
  to.length = sizeof address;
  return to;
}

struct Lookup {
  int error = 0;  // from getaddrinfo
  std::vector<SocketAddress> addresses;
};

Lookup look_up(const std::string& host, std::uint16_t port, int flags) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = flags;
  addrinfo* list = nullptr;
  Lookup lookup;
  lookup.error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (lookup.error != 0) return lookup;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(list, &::freeaddrinfo);
  for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next) {
    if (entry->ai_family != AF_INET && entry->ai_family != AF_INET6) continue;
    SocketAddress& address = lookup.addresses.emplace_back();
    std::memcpy(&address.storage, entry->ai_addr, entry->ai_addrlen);
    address.length = entry->ai_addrlen;
  }
  return lookup;
}

// An IPv6 address and the zone after its %; empty without a zone.
std::pair<std::string, std::string> split_zone(const std::string& host) {
  const std::size_t percent = host.find('%');
  if (percent == std::string::npos || host.find(':') >= percent) return {host, {}};
  return {host.substr(0, percent), host.substr(percent + 1)};
}

}  // namespace

std::vector<SocketAddress> resolve(const std::string& host, std::uint16_t port) {
  // Without the zone, because the resolver knows only existing interfaces.
  Lookup lookup = look_up(split_zone(host).first, port, 0);
  if (lookup.error != 0) {
    const std::string reason =
        lookup.error == EAI_SYSTEM ? base::system_text(errno) : std::string(::gai_strerror(lookup.error));
    throw TransportError("host \"" + host + "\": " + reason);
  }
  if (lookup.addresses.empty()) {
    throw TransportError("host \"" + host + "\": has neither an IPv4 nor an IPv6 address");
  }
  std::stable_partition(lookup.addresses.begin(), lookup.addresses.end(),
                        [](const SocketAddress& address) { return address.family() == AF_INET; });
  return std::move(lookup.addresses);
}

std::string zone_of(const std::string& host) { return split_zone(host).second; }

std::optional<SocketAddress> numeric_address(const std::string& text) {
  const Lookup lookup = look_up(split_zone(text).first, 0, AI_NUMERICHOST);
  if (lookup.addresses.empty()) return {};
  return lookup.addresses.front();
}

SocketAddress any_ipv6(std::uint16_t port) noexcept {
  sockaddr_in6 address{};
  address.sin6_family = AF_INET6;
  address.sin6_port = htons(port);
  address.sin6_addr = in6addr_any;
  return from(address);
}

SocketAddress any_ipv4(std::uint16_t port) noexcept {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  return from(address);
}

Sender sender_of(const sockaddr_storage& storage) noexcept {
  Sender sender;
  if (storage.ss_family == AF_INET) {
    const auto address = as<sockaddr_in>(storage);
    sender.kind = SenderKind::ipv4;
    sender.number = ntohs(address.sin_port);
    std::memcpy(sender.address.data(), &address.sin_addr, sizeof address.sin_addr);
  } else if (storage.ss_family == AF_INET6) {
    const auto address = as<sockaddr_in6>(storage);
    const bool mapped = IN6_IS_ADDR_V4MAPPED(&address.sin6_addr);
    sender.kind = mapped ? SenderKind::ipv4 : SenderKind::ipv6;
    sender.number = ntohs(address.sin6_port);
    std::memcpy(sender.address.data(), address.sin6_addr.s6_addr + (mapped ? 12 : 0), mapped ? 4 : 16);
  }
  return sender;
}

bool is_any(const SocketAddress& address) noexcept {
  if (address.family() == AF_INET) return as<sockaddr_in>(address.storage).sin_addr.s_addr == htonl(INADDR_ANY);
  const auto ipv6 = as<sockaddr_in6>(address.storage);
  return IN6_IS_ADDR_UNSPECIFIED(&ipv6.sin6_addr);
}

bool is_multicast(const SocketAddress& address) noexcept {
  if (address.family() == AF_INET) return IN_MULTICAST(ntohl(as<sockaddr_in>(address.storage).sin_addr.s_addr));
  const auto ipv6 = as<sockaddr_in6>(address.storage);
  return IN6_IS_ADDR_MULTICAST(&ipv6.sin6_addr);
}

bool needs_zone(const SocketAddress& address) noexcept {
  if (address.family() != AF_INET6) return false;
  const auto ipv6 = as<sockaddr_in6>(address.storage);
  return IN6_IS_ADDR_LINKLOCAL(&ipv6.sin6_addr) || IN6_IS_ADDR_MC_LINKLOCAL(&ipv6.sin6_addr) ||
         IN6_IS_ADDR_MC_NODELOCAL(&ipv6.sin6_addr);
}

unsigned zone_index(const SocketAddress& address) noexcept {
  return address.family() == AF_INET6 ? as<sockaddr_in6>(address.storage).sin6_scope_id : 0;
}

void set_zone(SocketAddress& ipv6, unsigned interface_index) noexcept {
  reinterpret_cast<sockaddr_in6&>(ipv6.storage).sin6_scope_id = interface_index;
}

void set_port(SocketAddress& address, std::uint16_t port) noexcept {
  // Both families have the port at the same offset.
  static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
  reinterpret_cast<sockaddr_in&>(address.storage).sin_port = htons(port);
}

bool is_local(SocketAddress address) noexcept {
  const Descriptor probe(::socket(address.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0));
  set_port(address, 0);
  return probe.is_open() && ::bind(probe.get(), address.get(), address.length) == 0;
}

bool is_broadcast(const SocketAddress& address) noexcept {
  if (address.family() != AF_INET) return false;
  // If a socket has no broadcast option, the kernel refuses broadcast addresses with EACCES, and only these. Nothing is
  // sent.
  const Descriptor probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  SocketAddress target = address;
  set_port(target, 9);
  return probe.is_open() && ::connect(probe.get(), target.get(), target.length) != 0 && errno == EACCES;
}

SocketAddress bound_address(int fd) {
  SocketAddress address;
  address.length = sizeof address.storage;
  if (::getsockname(fd, address.get(), &address.length) != 0) {
    throw TransportError("the port of the socket cannot be read: " + base::system_text(errno));
  }
  return address;
}

}  // namespace trk_bridge::transport
