// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Multicast groups over the loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ifaddrs.h>
#include <net/if.h>

#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk::udp_multicast_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::port_of;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::Source;
using transport::SourceState;
using transport::TransportError;

std::string place(const std::string& group, const Source& of_port, const std::string& options) {
  return "udp://" + group + ":" + std::to_string(port_of(of_port)) + options;
}

TEST(UdpMulticast, ReadersOfAGroupShareThePort) {
  const std::string through = "?interface=127.0.0.1";
  const auto one = open_source("udp://239.255.77.11:0" + through);
  const auto other = open_source(place("239.255.77.11", *one, through));
  const auto stranger = open_source(place("239.255.77.12", *one, through));
  EXPECT_THAT(one->name(), HasSubstr("of group 239.255.77.11 through 127.0.0.1"));
  const auto sink = open_sink(place("239.255.77.11", *one, through + "&ttl=0"));
  for (std::uint64_t i = 0; i < 10; ++i) ASSERT_TRUE(sink->write(test::params(i)));
  for (std::uint64_t i = 0; i < 10; ++i) {
    EXPECT_EQ(test::next_counter(*one), i);
    EXPECT_EQ(test::next_counter(*other), i);
  }
  // A datagram for the other group would have arrived before this one.
  const auto own = open_sink(place("239.255.77.12", *one, through + "&ttl=0"));
  ASSERT_TRUE(own->write(test::params(99)));
  EXPECT_EQ(test::next_counter(*stranger), 99u);
}

TEST(UdpMulticast, TheInterfaceMayBeNamed) {
  const auto source = open_source("udp://239.255.77.13:0?interface=lo");
  const auto sink = open_sink(place("239.255.77.13", *source, "?interface=lo&ttl=0"));
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(test::next_counter(*source), 1u);
}

TEST(UdpMulticast, SendersAreReportedAndCanBeRefused) {
  const auto source = open_source("udp://239.255.77.14:0?interface=127.0.0.1&allow=127.0.0.2");
  const auto sink = open_sink(place("239.255.77.14", *source, "?interface=127.0.0.1&ttl=0"));
  ASSERT_TRUE(sink->write(test::params(1)));
  Reception reception;
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), Event::idle);
  EXPECT_EQ(source->statistics().state, SourceState::only_refused);
  EXPECT_THAT(to_string(source->statistics().last_refused), HasSubstr("127.0.0.1:"));
}

TEST(UdpMulticast, AReaderWithoutGroupKeepsItsPort) {
  const auto group = open_source("udp://239.255.77.15:0?interface=127.0.0.1");
  EXPECT_THROW((void)open_source(place("0.0.0.0", *group, "")), TransportError);
  EXPECT_NO_THROW((void)open_source(place("127.0.0.1", *group, ""))) << "another address is another socket";
}

/// An interface that is up, has multicast and an IPv6 address; empty if there is none.
std::string ipv6_interface() {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return {};
  std::string name;
  for (const ifaddrs* entry = list; entry != nullptr && name.empty(); entry = entry->ifa_next) {
    const bool able = (entry->ifa_flags & IFF_UP) != 0 && (entry->ifa_flags & IFF_MULTICAST) != 0;
    if (able && entry->ifa_addr != nullptr && entry->ifa_addr->sa_family == AF_INET6) name = entry->ifa_name;
  }
  ::freeifaddrs(list);
  return name;
}

TEST(UdpMulticast, Ipv6GroupOfThisMachine) {
  const std::string interface = ipv6_interface();
  if (interface.empty()) GTEST_SKIP() << "no interface with IPv6 multicast";
  // The scope ff11 never leaves the machine, whatever the interface.
  const auto one = open_source("udp://[ff11::7:77]:0?interface=" + interface);
  const auto other = open_source(place("[ff11::7:77]", *one, "?interface=" + interface));
  const auto sink = open_sink(place("[ff11::7:77]", *one, "?ttl=0&interface=" + interface));
  ASSERT_TRUE(sink->write(test::params(6)));
  EXPECT_EQ(test::next_counter(*one), 6u);
  EXPECT_EQ(test::next_counter(*other), 6u);
}

}  // namespace trk_bridge::trk::udp_multicast_test
