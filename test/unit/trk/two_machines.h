// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Two machines, each a network namespace, with a cable between them: what they send and receive while interfaces
// change.
#pragma once

#include <gtest/gtest.h>
#include <net/if.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "network_namespace.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk {

inline constexpr std::uint16_t port = 7000;  // every namespace has its own ports
inline constexpr std::chrono::milliseconds poll_period(5);
inline constexpr std::chrono::milliseconds longest_recovery(5000);  // on a busy machine

/// A machine "near" with the sources and sinks, and a machine "far", connected by a cable from v0 to v1.
struct Network {
  test::NetworkNamespace near, far;

  void plug_in(const std::string& options = "") const {
    near.ip("link add v0 " + options + " type veth peer name v1 netns " + far.path() +
            "\nlink set v0 addrgenmode none\nlink set v0 up");
    far.ip(
        "link set v1 addrgenmode none\nlink set v1 up\naddr add 10.9.0.2/24 dev v1\naddr add 192.0.2.7/32 dev v1\n"
        "addr add fd00:9::2/64 dev v1 nodad\naddr add 2001:db8::7/128 dev v1 nodad\naddr add fe80::2/64 dev v1 nodad\n"
        "route replace 239.0.0.0/8 dev v1\nroute replace default via 10.9.0.1");
    add_addresses();
  }
  void unplug() const { near.ip("link del v0"); }
  void clear() const {
    const test::NetworkNamespace::Stay stay(near);
    for (const std::string name : {"v0", "w0", "old0"}) {
      if (::if_nametoindex(name.c_str()) != 0) near.ip("link del " + name);
    }
  }
  void add_addresses(const std::string& interface = "v0") const {
    near.ip("addr replace 10.9.0.1/24 broadcast + dev " + interface + "\naddr replace fd00:9::1/64 dev " + interface +
            " nodad\naddr replace fe80::1/64 dev " + interface + " nodad\nroute replace 239.0.0.0/8 dev " + interface);
  }
  void remove_addresses(const std::string& interface = "v0") const { near.ip("addr flush dev " + interface); }
};

inline bool is_ipv6(const std::string& address) { return address.find("::") != std::string::npos; }

/// Sends from the far machine to an address or group through v1.
class FarSender {
 public:
  FarSender(const Network& network, const std::string& to) : to_(*transport_address(to)) {
    const test::NetworkNamespace::Stay stay(network.far);
    fd_ = ::socket(to_.ss_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const int index = static_cast<int>(::if_nametoindex("v1"));
    ip_mreqn through{};
    through.imr_ifindex = index;
    if (to_.ss_family == AF_INET) {
      ::setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_IF, &through, sizeof through);
    } else {
      reinterpret_cast<sockaddr_in6&>(to_).sin6_scope_id = static_cast<unsigned>(index);
    }
  }
  ~FarSender() { ::close(fd_); }
  FarSender(const FarSender&) = delete;
  FarSender& operator=(const FarSender&) = delete;

  /// Only the receiver knows whether it arrives.
  void send(const std::string& datagram) const {
    (void)::sendto(fd_, datagram.data(), datagram.size(), MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&to_),
                   to_.ss_family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6));
  }

 private:
  static std::optional<sockaddr_storage> transport_address(const std::string& address) {
    sockaddr_storage storage{};
    if (is_ipv6(address)) {
      auto& to = reinterpret_cast<sockaddr_in6&>(storage);
      to.sin6_family = AF_INET6;
      to.sin6_port = htons(port);
      if (::inet_pton(AF_INET6, address.c_str(), &to.sin6_addr) != 1) return {};
    } else {
      auto& to = reinterpret_cast<sockaddr_in&>(storage);
      to.sin_family = AF_INET;
      to.sin_port = htons(port);
      if (::inet_pton(AF_INET, address.c_str(), &to.sin_addr) != 1) return {};
    }
    return storage;
  }

  sockaddr_storage to_;
  int fd_;
};

inline constexpr const char* ipv4_group = "239.9.9.9";
inline constexpr const char* ipv6_group = "ff15::9";
inline constexpr const char* link_group = "ff02::9:9";

/// Receives on the far machine through one interface.
class FarReceiver {
 public:
  explicit FarReceiver(const Network& network, const std::string& interface = "v1") {
    const test::NetworkNamespace::Stay stay(network.far);
    fd_ = ::socket(AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in6 any{};
    any.sin6_family = AF_INET6;
    any.sin6_port = htons(port);
    EXPECT_EQ(::setsockopt(fd_, SOL_SOCKET, SO_BINDTODEVICE, interface.c_str(), 3), 0);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0) << std::strerror(errno);
    for (const std::string group : {ipv4_group, ipv6_group, link_group}) {
      group_req request{};
      request.gr_interface = ::if_nametoindex(interface.c_str());
      const int family = is_ipv6(group) ? AF_INET6 : AF_INET;
      request.gr_group.ss_family = static_cast<sa_family_t>(family);
      ::inet_pton(family, group.c_str(),
                  family == AF_INET ? static_cast<void*>(&reinterpret_cast<sockaddr_in&>(request.gr_group).sin_addr)
                                    : &reinterpret_cast<sockaddr_in6&>(request.gr_group).sin6_addr);
      EXPECT_EQ(
          ::setsockopt(fd_, family == AF_INET ? IPPROTO_IP : IPPROTO_IPV6, MCAST_JOIN_GROUP, &request, sizeof request),
          0)
          << group << ": " << std::strerror(errno);
    }
  }
  ~FarReceiver() { ::close(fd_); }
  FarReceiver(const FarReceiver&) = delete;
  FarReceiver& operator=(const FarReceiver&) = delete;

  bool receives(std::chrono::milliseconds wait) const {
    pollfd watched{fd_, POLLIN, 0};
    if (::poll(&watched, 1, static_cast<int>(wait.count())) != 1) return false;
    char data[512];
    return ::recv(fd_, data, sizeof data, 0) > 0;
  }

 private:
  int fd_;
};

/// Waits until `works`; returns the time that it took, none after the longest recovery.
template <typename Works>
std::optional<std::chrono::milliseconds> time_until(const Works& works) {
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < longest_recovery) {
    if (works()) return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  }
  return {};
}

inline bool gets_one(transport::Source& source, const FarSender& tracker) {
  static std::uint64_t counter = 0;
  tracker.send(test::datagram(test::params(++counter)));
  transport::Reception reception;
  return source.receive(reception, poll_period) == transport::Event::sample;
}

inline bool sends_one(transport::Sink& sink, const FarReceiver& receiver) {
  (void)sink.write(test::params(1));
  return receiver.receives(poll_period);
}

class NetworkTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      if (!network) network.emplace();
    } catch (const std::runtime_error& why) {
      GTEST_SKIP() << why.what();
    }
  }
  void TearDown() override {
    if (network) network->clear();
  }

  std::unique_ptr<transport::Source> source_at(const std::string& url) {
    const test::NetworkNamespace::Stay stay(network->near);
    return endpoints::open_source(url);
  }
  std::unique_ptr<transport::Sink> sink_to(const std::string& url) {
    const test::NetworkNamespace::Stay stay(network->near);
    return endpoints::open_sink(url);
  }
  std::string waiting_for(const transport::Source& source) {
    const test::NetworkNamespace::Stay stay(network->near);
    return source.statistics().waiting_for;
  }

  // One for all tests: creating it takes longer than most tests.
  static inline std::optional<Network> network;
};

}  // namespace trk_bridge::trk
