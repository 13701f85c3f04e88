// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Interfaces, addresses and routes that are removed and added, in private network namespaces: after every event,
// records are received again automatically.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "network_namespace.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk {
namespace {

using endpoints::open_sink;
using endpoints::open_source;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test::NetworkNamespace;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using transport::Event;
using transport::Reception;
using transport::Sink;
using transport::SinkReason;
using transport::Source;

constexpr std::uint16_t port = 7000;  // every namespace has its own ports
constexpr milliseconds poll_period(5);
constexpr milliseconds longest_recovery(5000);  // on a busy machine

/// A machine "near" with the sources and sinks, and a machine "far", connected by a cable from v0 to v1.
struct Network {
  NetworkNamespace near, far;

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
    const NetworkNamespace::Stay stay(near);
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

bool is_ipv6(const std::string& address) { return address.find("::") != std::string::npos; }

/// Sends from the far machine to an address or group through v1.
class FarSender {
 public:
  FarSender(const Network& network, const std::string& to) : to_(*transport_address(to)) {
    const NetworkNamespace::Stay stay(network.far);
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

const char* const ipv4_group = "239.9.9.9";
const char* const ipv6_group = "ff15::9";
const char* const link_group = "ff02::9:9";

/// Receives on the far machine through one interface.
class FarReceiver {
 public:
  explicit FarReceiver(const Network& network, const std::string& interface = "v1") {
    const NetworkNamespace::Stay stay(network.far);
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

  bool receives(milliseconds wait) const {
    pollfd watched{fd_, POLLIN, 0};
    if (::poll(&watched, 1, static_cast<int>(wait.count())) != 1) return false;
    char data[512];
    return ::recv(fd_, data, sizeof data, 0) > 0;
  }

 private:
  int fd_;
};

/// How a source or a sink is opened.
struct Way {
  const char* name;
  const char* url;
  const char* to;    ///< for sources: the address or group that the far machine sends to
  const char* tied;  ///< what waiting_for names if it is missing; for sinks: empty or not
  bool is_route_decisive = false;
};

/// An event of the network: how it starts and how it ends.
struct NetworkEvent {
  const char* name;
  bool is_there_before;
  void (*apply)(const Network&);
  void (*ends)(const Network&);
};

const Way sources[] = {
    {"every_interface", "udp://:7000", "10.9.0.1", ""},
    {"address", "udp://10.9.0.1:7000", "10.9.0.1", "10.9.0.1"},
    {"group", "udp://239.9.9.9:7000", ipv4_group, ""},
    {"group_by_name", "udp://239.9.9.9:7000?interface=v0", ipv4_group, "v0"},
    {"group_by_address", "udp://239.9.9.9:7000?interface=10.9.0.1", ipv4_group, "10.9.0.1"},
    {"ipv6_every_interface", "udp://:7000", "fd00:9::1", ""},
    {"ipv6_address", "udp://[fd00:9::1]:7000", "fd00:9::1", "fd00:9::1"},
    {"ipv6_address_of_link", "udp://[fe80::1%25v0]:7000", "fe80::1", "v0"},
    {"ipv6_group", "udp://[ff15::9]:7000", ipv6_group, ""},
    {"ipv6_group_by_name", "udp://[ff15::9]:7000?interface=v0", ipv6_group, "v0"},
    {"ipv6_group_by_address", "udp://[ff15::9]:7000?interface=fd00:9::1", ipv6_group, "fd00:9::1"},
    {"ipv6_group_of_link", "udp://[ff02::9:9]:7000?interface=v0", link_group, "v0"},
    {"ipv6_group_with_zone", "udp://[ff02::9:9%25v0]:7000", link_group, "v0"},
};

constexpr Way sinks[] = {
    {"address", "udp://10.9.0.2:7000", "", ""},
    {"routed_address", "udp://192.0.2.7:7000", "", "", true},
    {"broadcast", "udp://10.9.0.255:7000", "", ""},
    {"group", "udp://239.9.9.9:7000", "", "", true},
    {"group_by_name", "udp://239.9.9.9:7000?interface=v0", "", "v0"},
    {"group_by_address", "udp://239.9.9.9:7000?interface=10.9.0.1", "", "v0"},
    {"ipv6_address", "udp://[fd00:9::2]:7000", "", ""},
    {"ipv6_routed_address", "udp://[2001:db8::7]:7000", "", "", true},
    {"ipv6_address_of_link", "udp://[fe80::2%25v0]:7000", "", "v0"},
    {"ipv6_group", "udp://[ff15::9]:7000", "", ""},
    {"ipv6_group_by_name", "udp://[ff15::9]:7000?interface=v0", "", "v0"},
    {"ipv6_group_by_address", "udp://[ff15::9]:7000?interface=fd00:9::1", "", "v0"},
    {"ipv6_group_of_link", "udp://[ff02::9:9]:7000?interface=v0", "", "v0"},
};

void add_routes(const Network& n) {
  n.near.ip(
      "route replace 239.0.0.0/8 dev v0\nroute replace 192.0.2.0/24 via 10.9.0.2\n"
      "route replace 2001:db8::/64 via fd00:9::2");
}

const NetworkEvent events[] = {
    {"link_down", true, [](const Network& n) { n.near.ip("link set v0 down"); },
     [](const Network& n) {
       n.near.ip("link set v0 up");
       n.add_addresses();
     }},
    {"address_deleted", true, [](const Network& n) { n.remove_addresses(); },
     [](const Network& n) { n.add_addresses(); }},
    {"interface_removed", true, [](const Network& n) { n.unplug(); }, [](const Network& n) { n.plug_in(); }},
    {"interface_removed_for_a_moment", true, [](const Network&) {},
     [](const Network& n) {
       n.unplug();
       n.plug_in();
     }},
    {"interface_back_with_its_number", true, [](const Network& n) { n.unplug(); },
     [](const Network& n) { n.plug_in("index 77"); }},
    {"interface_appears", false, [](const Network&) {}, [](const Network& n) { n.plug_in(); }},
};

/// Waits until `works`; returns the time that it took, none after the longest recovery.
template <typename Works>
std::optional<milliseconds> time_until(const Works& works) {
  const auto begin = steady_clock::now();
  while (steady_clock::now() - begin < longest_recovery) {
    if (works()) return std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
  }
  return {};
}

bool gets_one(Source& source, const FarSender& tracker) {
  static std::uint64_t counter = 0;
  tracker.send(test::datagram(test::params(++counter)));
  Reception reception;
  return source.receive(reception, poll_period) == Event::sample;
}

bool sends_one(Sink& sink, const FarReceiver& receiver) {
  (void)sink.write(test::params(1));
  return receiver.receives(poll_period);
}

/// Ends the event and waits until `works`; prints how long that took, since the first and since the last command.
template <typename Works>
void expect_recovery(const std::string& what, const Way& way, const std::string& happening,
                     const std::function<void()>& ends, const Works& make_works) {
  const auto begin = steady_clock::now();
  ends();
  const auto commands = std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
  const auto recovery = time_until(make_works());
  ASSERT_TRUE(recovery) << "never recovered";
  std::printf("[ RECOVERY ] %s %s after %s: %ld ms, %ld ms with the commands\n", what.c_str(), way.name,
              happening.c_str(), static_cast<long>(recovery->count()),
              static_cast<long>((commands + *recovery).count()));
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

  std::unique_ptr<Source> source_at(const std::string& url) {
    const NetworkNamespace::Stay stay(network->near);
    return open_source(url);
  }
  std::unique_ptr<Sink> sink_to(const std::string& url) {
    const NetworkNamespace::Stay stay(network->near);
    return open_sink(url);
  }
  std::string waiting_for(const Source& source) {
    const NetworkNamespace::Stay stay(network->near);
    return source.statistics().waiting_for;
  }

  // One for all tests: creating it takes longer than most tests.
  static inline std::optional<Network> network;
};

using Case = std::tuple<NetworkEvent, Way>;

class Recovery : public NetworkTest, public testing::WithParamInterface<Case> {
 protected:
  const NetworkEvent& event() const { return std::get<0>(GetParam()); }
  const Way& way() const { return std::get<1>(GetParam()); }
};

class SourceRecovery : public Recovery {};
class SinkRecovery : public Recovery {};

TEST_P(SourceRecovery, RecordsAreReceivedAgain) {
  if (event().is_there_before) network->plug_in("index 77");
  const auto source = source_at(way().url);
  if (event().is_there_before) {
    const FarSender tracker(*network, way().to);
    ASSERT_TRUE(time_until([&] { return gets_one(*source, tracker); })) << "before anything happens";
    ASSERT_THAT(waiting_for(*source), IsEmpty());
  }
  event().apply(*network);
  std::optional<FarSender> tracker;
  expect_recovery(
      "source", way(), event().name, [&] { event().ends(*network); },
      [&] {
        tracker.emplace(*network, way().to);
        return [&] { return gets_one(*source, *tracker); };
      });
  EXPECT_THAT(waiting_for(*source), IsEmpty());
}

TEST_P(SinkRecovery, RecordsArriveAgain) {
  if (event().is_there_before) {
    network->plug_in("index 77");
    add_routes(*network);
  }
  const auto sink = sink_to(way().url);
  if (event().is_there_before) {
    const FarReceiver receiver(*network);
    ASSERT_TRUE(time_until([&] { return sends_one(*sink, receiver); })) << "before anything happens";
  }
  event().apply(*network);
  std::optional<FarReceiver> receiver;
  const auto ends = [&] {
    event().ends(*network);
    add_routes(*network);
  };
  expect_recovery("sink", way(), event().name, ends, [&] {
    receiver.emplace(*network);
    return [&] { return sends_one(*sink, *receiver); };
  });
  const auto before = sink->statistics();
  EXPECT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(sink->statistics().params, before.params + 1);
  EXPECT_EQ(sink->statistics().errors, before.errors);
}

std::string name_of_case(const testing::TestParamInfo<Case>& info) {
  return std::string(std::get<1>(info.param).name) + "_after_" + std::get<0>(info.param).name;
}
INSTANTIATE_TEST_SUITE_P(Networks, SourceRecovery,
                         testing::Combine(testing::ValuesIn(events), testing::ValuesIn(sources)), name_of_case);
INSTANTIATE_TEST_SUITE_P(Networks, SinkRecovery, testing::Combine(testing::ValuesIn(events), testing::ValuesIn(sinks)),
                         name_of_case);

class SourceOutage : public NetworkTest, public testing::WithParamInterface<Way> {};
class SinkOutage : public NetworkTest, public testing::WithParamInterface<Way> {};

TEST_P(SourceOutage, ReportsWhatItWaitsFor) {
  const Way& way = GetParam();
  const auto source = source_at(way.url);
  EXPECT_THAT(waiting_for(*source), AllOf(HasSubstr("udp port 7000: "), HasSubstr(way.tied)));
  network->plug_in();
  ASSERT_TRUE(time_until([&] { return waiting_for(*source) == "udp port 7000: bound, nothing received yet"; }))
      << waiting_for(*source);
  const FarSender tracker(*network, way.to);
  ASSERT_TRUE(time_until([&] { return gets_one(*source, tracker); }));
  for (const char* change : {"link set v0 down", "link del v0"}) {
    network->near.ip(change);
    if (*way.tied != '\0') {
      EXPECT_THAT(waiting_for(*source), HasSubstr(way.tied)) << change;
    }
    EXPECT_NE(source->statistics().state, transport::SourceState::failed);
  }
}

TEST_P(SinkOutage, IsAFaultWhileItLasts) {
  const Way& way = GetParam();
  const auto sink = sink_to(way.url);
  const auto fails = [&sink] { return !sink->write(test::params(1)); };
  EXPECT_TRUE(fails()) << "nothing is there";
  network->plug_in();
  for (const char* change : {"link set v0 down", "addr flush dev v0", "link del v0"}) {
    // If a route remains, the kernel sends from any remaining address.
    if (way.is_route_decisive && is_ipv6(way.url) && change == std::string("addr flush dev v0")) continue;
    add_routes(*network);
    const FarReceiver receiver(*network);
    ASSERT_TRUE(time_until([&] { return sends_one(*sink, receiver); })) << "before " << change;
    network->near.ip(change);
    // The kernel may report it a little later.
    EXPECT_TRUE(time_until(fails)) << change;
    for (int i = 0; i < 5; ++i) {
      const auto errors = sink->statistics().errors;
      EXPECT_TRUE(fails()) << change;
      EXPECT_EQ(sink->statistics().errors, errors + 1);
    }
    if (change == std::string("link del v0")) {
      if (*way.tied != '\0') {
        EXPECT_TRUE(
            time_until([&] { return sink->write(test::params(1)).error().reason == SinkReason::no_interface; }));
      }
      continue;
    }
    network->near.ip("link set v0 up");
    network->add_addresses();
  }
}

std::string name_of_way(const testing::TestParamInfo<Way>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Networks, SourceOutage, testing::ValuesIn(sources), name_of_way);
INSTANTIATE_TEST_SUITE_P(Networks, SinkOutage, testing::ValuesIn(sinks), name_of_way);

class RouteAddedLater : public NetworkTest, public testing::WithParamInterface<Way> {};

TEST_P(RouteAddedLater, RecordsArrive) {
  const Way& way = GetParam();
  network->plug_in();
  network->near.ip("route del 239.0.0.0/8 dev v0");
  const auto sink = sink_to(way.url);
  const FarReceiver receiver(*network);
  if (way.is_route_decisive) {
    const auto written = sink->write(test::params(1));
    ASSERT_FALSE(written);
    EXPECT_THAT(describe(written.error()), HasSubstr("unreachable"));
  }
  expect_recovery(
      "sink", way, "route_added", [] { add_routes(*network); },
      [&] { return [&] { return sends_one(*sink, receiver); }; });
}
INSTANTIATE_TEST_SUITE_P(Networks, RouteAddedLater, testing::ValuesIn(sinks), name_of_way);

TEST_F(NetworkTest, AReaderThatWaitsInTheKernelUsesTheNewInterface) {
  // With a time limit it waits in another system call than without.
  for (const std::chrono::nanoseconds wait : {std::chrono::nanoseconds(test::deadline), std::chrono::nanoseconds(-1)}) {
    for (const Way& way : sources) {
      network->plug_in();
      const auto source = source_at(way.url);
      Reception reception;
      auto event = std::async(std::launch::async, [&] { return source->receive(reception, wait); });
      network->unplug();
      network->plug_in();
      const FarSender tracker(*network, way.to);
      EXPECT_TRUE(time_until([&] {
        tracker.send(test::datagram(test::params(7)));
        return event.wait_for(poll_period) == std::future_status::ready;
      })) << way.name;
      source->stop();
      EXPECT_EQ(event.get(), Event::sample) << way.name;
      network->unplug();
    }
  }
}

TEST_F(NetworkTest, AReaderThatWaitsInTheKernelIsStoppedWhateverInterfacesDo) {
  for (const Way& way : sources) {
    network->plug_in();
    const auto source = source_at(way.url);
    Reception reception;
    auto event =
        std::async(std::launch::async, [&] { return source->receive(reception, std::chrono::nanoseconds(-1)); });
    network->unplug();
    network->plug_in();
    source->stop();
    EXPECT_EQ(event.wait_for(test::deadline), std::future_status::ready) << way.name;
    EXPECT_EQ(event.get(), Event::stopped) << way.name;
    network->unplug();
  }
}

/// The cable from w0 to w1, whose far end has the addresses of v1.
void plug_in_another(const Network& n) {
  n.near.ip("link add w0 type veth peer name w1 netns " + n.far.path() +
            "\nlink set w0 addrgenmode none\nlink set w0 up");
  n.far.ip("link set w1 up");
}

TEST_F(NetworkTest, AnInterfaceThatTakesOverTheNameIsUsed) {
  network->plug_in();
  plug_in_another(*network);
  const auto sink = sink_to("udp://239.9.9.9:7000?interface=v0");
  const auto source = source_at("udp://239.9.9.9:7000?interface=v0");
  const FarReceiver through_v(*network, "v1"), through_w(*network, "w1");
  const FarSender through_v_sender(*network, ipv4_group);
  ASSERT_TRUE(time_until([&] { return sends_one(*sink, through_v); }));
  ASSERT_TRUE(time_until([&] { return gets_one(*source, through_v_sender); }));
  network->near.ip(
      "link set v0 down\nlink set v0 name old0\nlink set old0 up\nlink set w0 down\nlink set w0 name v0\n"
      "link set v0 up\naddr add 10.9.1.1/24 dev v0");
  EXPECT_TRUE(time_until([&] { return sends_one(*sink, through_w); }));
  while (through_v.receives(milliseconds(0))) {
  }
  EXPECT_FALSE(sends_one(*sink, through_v));
  EXPECT_TRUE(time_until([&] { return !gets_one(*source, through_v_sender); })) << "it has left the old one";
}

TEST_F(NetworkTest, AnAddressThatMovesIsFollowed) {
  network->plug_in();
  plug_in_another(*network);
  const auto sink = sink_to("udp://239.9.9.9:7000?interface=10.9.0.1");
  const FarReceiver through_v(*network, "v1"), through_w(*network, "w1");
  ASSERT_TRUE(time_until([&] { return sends_one(*sink, through_v); }));
  network->remove_addresses();
  network->add_addresses("w0");
  EXPECT_TRUE(time_until([&] { return sends_one(*sink, through_w); }));
}

TEST_F(NetworkTest, ManyInterfacesThatAppearAndDisappearLoseNoRecord) {
  network->plug_in();
  const auto source = source_at("udp://239.9.9.9:7000");
  const auto sink = sink_to("udp://239.9.9.9:7000?interface=v0");
  std::uint64_t counter = 0;
  for (int round = 0; round < 20; ++round) {
    std::string lines;
    for (int i = 0; i < 10; ++i) {
      const std::string name = "x" + std::to_string(i);
      lines += "link add " + name + " type veth peer name y" + std::to_string(i) + "\nlink set " + name +
               " up\naddr add 10.8." + std::to_string(i) + ".1/24 dev " + name + "\n";
    }
    for (int i = 0; i < 10; ++i) lines += "link del x" + std::to_string(i) + "\n";
    network->near.ip(lines);
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(sink->write(test::params(++counter)));
      ASSERT_EQ(test::next_counter(*source), counter) << "the group is looped back to this machine";
    }
  }
}

}  // namespace
}  // namespace trk_bridge::trk
