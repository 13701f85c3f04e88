#include "multicast.h"

#include <ifaddrs.h>
#include <net/if.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include "socket_option.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {

namespace {

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
