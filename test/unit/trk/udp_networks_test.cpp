// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Interfaces, addresses and routes that are removed and added, in private network namespaces: after every event,
// records are received again automatically.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <string>
#include <tuple>

#include "two_machines.h"

namespace trk_bridge::trk::udp_networks_test {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using transport::Event;
using transport::Reception;
using transport::SinkReason;

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

/// Ends the event and waits until `works`; prints how long that took, since the first and since the last command.
template <typename Works>
void expect_recovery(const std::string& what, const Way& way, const std::string& event,
                     const std::function<void()>& ends, const Works& make_works) {
  const auto begin = steady_clock::now();
  ends();
  const auto commands = std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
  const auto recovery = time_until(make_works());
  ASSERT_TRUE(recovery) << "never recovered";
  std::printf("[ RECOVERY ] %s %s after %s: %ld ms, %ld ms with the commands\n", what.c_str(), way.name, event.c_str(),
              static_cast<long>(recovery->count()), static_cast<long>((commands + *recovery).count()));
}

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
    ASSERT_TRUE(time_until([&] { return gets_one(*source, tracker); })) << "before the event";
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
    ASSERT_TRUE(time_until([&] { return sends_one(*sink, receiver); })) << "before the event";
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

}  // namespace trk_bridge::trk::udp_networks_test
