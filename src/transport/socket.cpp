#include "socket.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>

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
  int error = 0;  // of getaddrinfo
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

// <linux/in6.h> has it, but cannot stand beside <netinet/in.h>.
constexpr int ipv6_multicast_all = 29;

struct InterfaceAddress {
  std::string name;
  unsigned flags = 0;
  SocketAddress address;
};

std::vector<InterfaceAddress> interface_addresses() {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) {
    throw TransportError("the interfaces cannot be listed: " + std::generic_category().message(errno));
  }
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owner(list, &::freeifaddrs);
  std::vector<InterfaceAddress> addresses;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr) continue;
    const int family = entry->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    InterfaceAddress& to = addresses.emplace_back();
    to.name = entry->ifa_name;
    to.flags = entry->ifa_flags;
    to.address.length = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    std::memcpy(&to.address.storage, entry->ifa_addr, to.address.length);
  }
  return addresses;
}

// Port and zone do not count.
bool same_address(const SocketAddress& a, const SocketAddress& b) noexcept {
  const Sender left = sender_of(a.storage), right = sender_of(b.storage);
  return left.kind == right.kind && left.address == right.address;
}

std::vector<unsigned> joinable_interfaces(int family) {
  std::set<unsigned> indices;
  for (const InterfaceAddress& entry : interface_addresses()) {
    const bool hears = (entry.flags & IFF_UP) != 0 && (entry.flags & (IFF_MULTICAST | IFF_LOOPBACK)) != 0;
    if (hears && entry.address.family() == family) indices.insert(::if_nametoindex(entry.name.c_str()));
  }
  if (indices.empty()) throw TransportError("no interface that is up can do multicast");
  return {indices.begin(), indices.end()};
}

// The interface that `%ZONE` named; 0 when none did.
unsigned zone_of(const SocketAddress& address) noexcept {
  if (address.family() != AF_INET6) return 0;
  return reinterpret_cast<const sockaddr_in6&>(address.storage).sin6_scope_id;
}

void join_through(int fd, const SocketAddress& group, unsigned index) {
  group_req request{};
  request.gr_interface = index;
  request.gr_group = group.storage;
  const int level = group.family() == AF_INET ? IPPROTO_IP : IPPROTO_IPV6;
  if (::setsockopt(fd, level, MCAST_JOIN_GROUP, &request, sizeof request) == 0) return;
  const int error = errno;
  char name[IF_NAMESIZE] = "?";
  ::if_indextoname(index, name);
  throw TransportError("joining the group through interface " + std::string(name) +
                       " failed: " + std::generic_category().message(error) + " (interface=ADDR picks another one)");
}

}  // namespace

std::vector<SocketAddress> resolve(const std::string& host, std::uint16_t port) {
  Lookup lookup = look_up(host, port, 0);
  if (lookup.error != 0) {
    const std::string reason =
        lookup.error == EAI_SYSTEM ? std::generic_category().message(errno) : std::string(::gai_strerror(lookup.error));
    throw TransportError("host \"" + host + "\": " + reason);
  }
  if (lookup.addresses.empty()) {
    throw TransportError("host \"" + host + "\": has neither an IPv4 nor an IPv6 address");
  }
  std::stable_partition(lookup.addresses.begin(), lookup.addresses.end(),
                        [](const SocketAddress& address) { return address.family() == AF_INET; });
  return std::move(lookup.addresses);
}

std::optional<SocketAddress> numeric_address(const std::string& text) {
  const Lookup lookup = look_up(text, 0, AI_NUMERICHOST);
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

bool is_broadcast(const SocketAddress& address) noexcept {
  if (address.family() != AF_INET) return false;
  // The kernel refuses broadcast, and that alone, with EACCES to a socket that did not ask for it. Nothing is sent.
  const Descriptor probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  auto ipv4 = as<sockaddr_in>(address.storage);
  if (ipv4.sin_port == 0) ipv4.sin_port = htons(9);
  const SocketAddress target = from(ipv4);
  return probe.is_open() && ::connect(probe.get(), target.get(), target.length) != 0 && errno == EACCES;
}

SocketAddress bound_address(int fd) {
  SocketAddress address;
  address.length = sizeof address.storage;
  if (::getsockname(fd, address.get(), &address.length) != 0) {
    throw TransportError("the port of the socket is not known: " + std::generic_category().message(errno));
  }
  return address;
}

Interface find_interface(const std::string& address_or_name) {
  if (const unsigned index = ::if_nametoindex(address_or_name.c_str()); index != 0) return {index, {}};
  const auto known = interface_addresses();
  const std::optional<SocketAddress> wanted = numeric_address(address_or_name);
  std::string there_are;
  for (const InterfaceAddress& entry : known) {
    if (wanted && same_address(entry.address, *wanted)) {
      Interface found;
      found.index = ::if_nametoindex(entry.name.c_str());
      if (wanted->family() == AF_INET) {
        found.ipv4 = reinterpret_cast<const sockaddr_in&>(wanted->storage).sin_addr;
      }
      return found;
    }
    if (there_are.find(entry.name) == std::string::npos) there_are += (there_are.empty() ? "" : ", ") + entry.name;
  }
  throw TransportError("interface \"" + address_or_name + "\": no interface has this address or name; there are " +
                       (there_are.empty() ? "none" : there_are));
}

void join_group(int fd, const SocketAddress& group, const std::string& interface) {
  if (group.family() == AF_INET) {
    set_option(fd, IPPROTO_IP, IP_MULTICAST_ALL, 0, "hearing only what was joined");
  } else {
    set_option(fd, IPPROTO_IPV6, ipv6_multicast_all, 0, "hearing only what was joined");
  }
  const unsigned zone = interface.empty() ? zone_of(group) : find_interface(interface).index;
  if (zone != 0) {
    join_through(fd, group, zone);
    return;
  }
  for (const unsigned index : joinable_interfaces(group.family())) join_through(fd, group, index);
}

void send_through(int fd, int family, const Interface& interface) {
  if (family == AF_INET) {
    ip_mreqn request{};
    request.imr_address = interface.ipv4;
    request.imr_ifindex = static_cast<int>(interface.index);
    set_option(fd, IPPROTO_IP, IP_MULTICAST_IF, request, "interface");
  } else {
    set_option(fd, IPPROTO_IPV6, IPV6_MULTICAST_IF, static_cast<int>(interface.index), "interface");
  }
}

}  // namespace trk_bridge::transport
