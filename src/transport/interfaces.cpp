// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "interfaces.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <set>
#include <utility>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>

#include "base/system_text.h"
#include "scheme.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

// From <linux/in6.h>, which cannot be included together with <netinet/in.h>.
constexpr int ipv6_multicast_all = 29;
constexpr int ipv6_unicast_if = 76;

constexpr std::chrono::seconds retry_period{1};

/// An address of an interface; its family is AF_UNSPEC if there is none.
struct InterfaceAddress {
  std::string name;
  unsigned index = 0;
  unsigned flags = 0;
  SocketAddress address;
};

std::vector<InterfaceAddress> interface_addresses() {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) throw TransportError("the interfaces cannot be listed: " + base::system_text(errno));
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owner(list, &::freeifaddrs);
  std::vector<InterfaceAddress> addresses;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    InterfaceAddress to;
    to.name = entry->ifa_name;
    to.index = ::if_nametoindex(entry->ifa_name);
    to.flags = entry->ifa_flags;
    const int family = entry->ifa_addr == nullptr ? AF_UNSPEC : entry->ifa_addr->sa_family;
    if (family == AF_INET || family == AF_INET6) {
      to.address.length = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
      std::memcpy(&to.address.storage, entry->ifa_addr, to.address.length);
    }
    if (to.index != 0) addresses.push_back(std::move(to));
  }
  return addresses;
}

// Port and zone are ignored.
bool same_address(const SocketAddress& a, const SocketAddress& b) noexcept {
  const Sender left = sender_of(a.storage), right = sender_of(b.storage);
  return left.kind == right.kind && left.address == right.address;
}

std::optional<Interface> find_in(const std::vector<InterfaceAddress>& known, const std::string& named) {
  const std::optional<SocketAddress> address = numeric_address(named);
  const unsigned number = whole_number(named, 1U, 0x7fffffffU).value_or(0U);
  const unsigned index = ::if_nametoindex(named.c_str());
  const auto found = std::find_if(known.begin(), known.end(), [&](const InterfaceAddress& entry) {
    if (index != 0) return entry.index == index;
    return entry.index == number || (address && same_address(entry.address, *address));
  });
  if (found == known.end()) return {};
  Interface interface;
  interface.index = found->index;
  interface.is_up = (found->flags & IFF_UP) != 0;
  interface.has_ipv4 = std::any_of(known.begin(), known.end(), [&found](const InterfaceAddress& entry) {
    return entry.index == found->index && entry.address.family() == AF_INET;
  });
  if (index == 0 && found->address.family() == AF_INET) {
    interface.ipv4 = reinterpret_cast<const sockaddr_in&>(found->address.storage).sin_addr;
  }
  return interface;
}

}  // namespace

bool is_interface_name_or_address(const std::string& text) {
  // The resolver would read 192.0.2 as 192.0.0.2.
  in_addr ipv4{};
  const bool is_number_or_ipv4 = text.find_first_not_of("0123456789.") == std::string::npos;
  if (is_number_or_ipv4 && text.find('.') != std::string::npos) return ::inet_pton(AF_INET, text.c_str(), &ipv4) == 1;
  const bool is_name = !text.empty() && text.size() < IF_NAMESIZE && text.find_first_of("/: \t\n") == std::string::npos;
  return is_name || numeric_address(text);
}

std::string interface_of(const std::string& host, const std::string& interface) {
  if (!interface.empty()) return interface;
  std::string zone = zone_of(host);
  if (!zone.empty() && !is_interface_name_or_address(zone)) {
    throw TransportError("host \"" + host + "\": after %, only the name of an interface is allowed");
  }
  return zone;
}

std::optional<Interface> find_interface(const std::string& named) { return find_in(interface_addresses(), named); }

std::string why_unusable(const std::string& named) {
  const auto known = interface_addresses();
  const auto interface = find_in(known, named);
  if (interface) return interface->is_up ? "" : "interface " + named + " is down";
  std::set<std::string> names;
  for (const InterfaceAddress& entry : known) names.insert(entry.name);
  std::string there_are;
  for (const std::string& name : names) there_are += (there_are.empty() ? "" : ", ") + name;
  return "no interface has the address or name " + named + "; there are " + (there_are.empty() ? "none" : there_are);
}

std::vector<unsigned> multicast_interfaces(int family) {
  std::set<unsigned> indices;
  for (const InterfaceAddress& entry : interface_addresses()) {
    const bool receives = (entry.flags & IFF_UP) != 0 && (entry.flags & (IFF_MULTICAST | IFF_LOOPBACK)) != 0;
    if (receives && entry.address.family() == family) indices.insert(entry.index);
  }
  return {indices.begin(), indices.end()};
}

namespace {

int change_membership(int fd, const SocketAddress& group, unsigned index, int option) noexcept {
  group_req request{};
  request.gr_interface = index;
  request.gr_group = group.storage;
  const int level = group.family() == AF_INET ? IPPROTO_IP : IPPROTO_IPV6;
  return ::setsockopt(fd, level, option, &request, sizeof request) == 0 ? 0 : errno;
}

}  // namespace

bool join_group(int fd, const SocketAddress& group, unsigned index) {
  const int error = change_membership(fd, group, index, MCAST_JOIN_GROUP);
  if (error == ENODEV) return false;
  if (error == 0) return true;
  char name[IF_NAMESIZE] = "?";
  ::if_indextoname(index, name);
  throw TransportError("joining the group through interface " + std::string(name) +
                       " failed: " + base::system_text(error) + " (interface=ADDR selects another one)");
}

void leave_group(int fd, const SocketAddress& group, unsigned index) noexcept {
  (void)change_membership(fd, group, index, MCAST_LEAVE_GROUP);
}

void receive_joined_only(int fd, int family) {
  if (family == AF_INET) {
    set_option(fd, IPPROTO_IP, IP_MULTICAST_ALL, 0, "hearing only what was joined");
  } else {
    set_option(fd, IPPROTO_IPV6, ipv6_multicast_all, 0, "hearing only what was joined");
  }
}

bool send_through(int fd, const SocketAddress& target, const Interface& interface) noexcept {
  if (target.family() == AF_INET) {
    ip_mreqn request{};
    request.imr_address = interface.ipv4;
    request.imr_ifindex = static_cast<int>(interface.index);
    return ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &request, sizeof request) == 0;
  }
  const bool group = is_multicast(target);
  // The first option is in host byte order, the second in network byte order.
  const unsigned index = group ? interface.index : htonl(interface.index);
  return ::setsockopt(fd, IPPROTO_IPV6, group ? IPV6_MULTICAST_IF : ipv6_unicast_if, &index, sizeof index) == 0;
}

InterfaceWatch::InterfaceWatch()
    : changes_(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE)) {
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR | RTMGRP_IPV6_IFADDR;
  if (!changes_.is_open() || ::bind(changes_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw TransportError("changes of the interfaces cannot be watched: " + base::system_text(errno));
  }
}

InterfaceWatch::~InterfaceWatch() {
  stop_.set();
  if (thread_.joinable()) thread_.join();
}

void InterfaceWatch::start(Follow follow) {
  follow_ = std::move(follow);
  thread_ = std::thread([this] { run(); });
}

void InterfaceWatch::run() {
  for (bool followed = true;;) {
    const Deadline retry(followed ? std::chrono::nanoseconds(-1) : std::chrono::nanoseconds(retry_period));
    const Wake wake = wait_readable(changes_.get(), stop_, retry);
    if (wake == Wake::stopped || wake == Wake::failed) return;
    followed = follow_(read_changes());
  }
}

InterfaceWatch::Removed InterfaceWatch::read_changes() {
  Removed removed;
  alignas(nlmsghdr) std::array<char, 32768> data;
  for (;;) {
    const ssize_t size = ::recv(changes_.get(), data.data(), data.size(), MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == ENOBUFS) removed.maybe_others = true;
    if (size < 0 && errno != ENOBUFS) return removed;
    auto left = static_cast<unsigned>(std::max<ssize_t>(size, 0));
    for (auto* message = reinterpret_cast<nlmsghdr*>(data.data()); NLMSG_OK(message, left);
         message = NLMSG_NEXT(message, left)) {
      const auto* link = static_cast<const ifinfomsg*>(NLMSG_DATA(message));
      // A bridge that releases an interface sends this message with another family.
      if (message->nlmsg_type == RTM_DELLINK && link->ifi_family == AF_UNSPEC) {
        removed.indices.push_back(static_cast<unsigned>(link->ifi_index));
      }
    }
  }
}

}  // namespace trk_bridge::transport
