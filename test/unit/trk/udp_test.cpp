// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The UDP source with plain sockets on the loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "error_of.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::trk::udp_test {

using endpoints::open_source;
using test::next;
using test::next_counter;
using test::PlainSocket;
using test::port_of;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::Source;
using transport::SourceState;
using transport::SourceStatistics;
using transport::TransportError;

std::int64_t realtime_now() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

std::string open_error(const std::string& url) {
  return test::error_of<TransportError>([&] { (void)open_source(url); });
}

void expect_gets(const std::string& url, const std::string& from, const std::string& to) {
  const auto source = open_source(url);
  const PlainSocket tracker(from);
  tracker.send(test::datagram(test::params(7)), to, port_of(*source));
  Reception reception;
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(7));
  const bool ipv6 = from.find(':') != std::string::npos;
  EXPECT_EQ(to_string(reception.sample.sender),
            (ipv6 ? "[" + from + "]" : from) + ":" + std::to_string(tracker.port()));
}

TEST(UdpSource, Ipv4) { expect_gets("udp://127.0.0.1:0", "127.0.0.5", "127.0.0.1"); }
TEST(UdpSource, EveryIpv4Interface) { expect_gets("udp://0.0.0.0:0", "127.0.0.5", "127.0.0.1"); }
TEST(UdpSource, Ipv6) { expect_gets("udp://[::1]:0", "::1", "::1"); }
TEST(UdpSource, EveryInterfaceReceivesIpv4ReportedAsIpv4) { expect_gets("udp://:0", "127.0.0.5", "127.0.0.1"); }
TEST(UdpSource, EveryInterfaceReceivesIpv6) { expect_gets("udp://:0", "::1", "::1"); }
TEST(UdpSource, AHostNameIsLookedUp) { expect_gets("udp://localhost:0", "127.0.0.5", "127.0.0.1"); }

TEST(UdpSource, NamesItsAddress) {
  const auto source = open_source("udp://127.0.0.1:0");
  const std::string port = std::to_string(port_of(*source));
  EXPECT_EQ(source->name(), "udp port " + port + " on 127.0.0.1");
  EXPECT_THAT(open_source("udp://:0")->name(), HasSubstr("on every interface"));
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  EXPECT_EQ(source->statistics().waiting_for, "udp port " + port + ": bound, nothing received yet");
}

/// Whether the arrival is between the times before and after sending, although the datagram is read much later.
bool is_stamped_by_kernel(Source& source, const PlainSocket& tracker) {
  const std::int64_t before = realtime_now();
  tracker.send(test::datagram(test::params(1)), "127.0.0.1", port_of(source));
  const std::int64_t after = realtime_now();
  while (realtime_now() < after + 5'000'000) std::this_thread::yield();
  Reception reception;
  EXPECT_EQ(next(source, reception), Event::sample);
  EXPECT_GE(reception.sample.arrival, before);
  return reception.sample.arrival >= before && reception.sample.arrival <= after;
}

TEST(UdpSource, TheArrivalIsTheKernelsStamp) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  // The kernel starts stamping a moment after the first socket of the machine requests it.
  const auto until = std::chrono::steady_clock::now() + test::deadline;
  while (!is_stamped_by_kernel(*source, tracker)) ASSERT_LT(std::chrono::steady_clock::now(), until);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(is_stamped_by_kernel(*source, tracker));
}

TEST(UdpSource, MoreThanABatchInOrder) {
  const auto source = open_source("udp://127.0.0.1:0?buffer=1000000");
  const PlainSocket tracker;
  for (std::uint64_t i = 0; i < 100; ++i) {
    tracker.send(test::datagram(test::params(i)), "127.0.0.1", port_of(*source));
  }
  Reception reception;
  for (std::uint64_t i = 0; i < 100; ++i) {
    // On the loopback a datagram has arrived when sending returns.
    ASSERT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), Event::sample);
    ASSERT_EQ(std::get<wire::CameraParams>(reception.sample.record).counter, i);
  }
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), Event::idle);
  EXPECT_EQ(source->statistics().records, 100u);
}

TEST(UdpSource, IdleAfterTheTimeGiven) {
  const auto source = open_source("udp://127.0.0.1:0");
  Reception reception;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(source->receive(reception, std::chrono::milliseconds(20)), Event::idle);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(20));
}

TEST(UdpSource, AnExtremelyLongWaitIsAWait) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  tracker.send("nothing", "127.0.0.1", port_of(*source));
  Reception reception;
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::max()), Event::malformed);
}

TEST(UdpSource, StatesAreReported) {
  const auto source = open_source("udp://127.0.0.1:0?allow=127.0.0.2");
  const PlainSocket allowed("127.0.0.2"), stranger("127.0.0.3");
  const std::uint16_t port = port_of(*source);
  Reception reception;
  EXPECT_EQ(source->statistics().state, SourceState::waiting);

  stranger.send(test::datagram(test::params(1)), "127.0.0.1", port);
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), Event::idle);
  EXPECT_EQ(source->statistics().state, SourceState::only_refused);
  EXPECT_EQ(source->statistics().refused, 1u);
  EXPECT_EQ(to_string(source->statistics().last_refused), "127.0.0.3:" + std::to_string(stranger.port()));

  allowed.send("hello", "127.0.0.1", port);
  EXPECT_EQ(next(*source, reception), Event::malformed);
  EXPECT_EQ(source->statistics().state, SourceState::nothing_valid);

  stranger.send(test::datagram(test::params(2)), "127.0.0.1", port);
  allowed.send(test::datagram(test::params(3)), "127.0.0.1", port);
  EXPECT_EQ(next_counter(*source), 3u);
  const auto s = source->statistics();
  EXPECT_EQ(s.state, SourceState::receiving);
  EXPECT_EQ(s.records, 1u);
  EXPECT_EQ(s.malformed, 1u);
  EXPECT_EQ(s.refused, 2u);
  EXPECT_TRUE(s.waiting_for.empty());
}

TEST(UdpSource, AllowListsApplyOnEveryInterfaceToo) {
  const auto source = open_source("udp://:0?allow=127.0.0.2,[::1]");
  const PlainSocket ipv4("127.0.0.2"), ipv6("::1"), stranger("127.0.0.3");
  stranger.send(test::datagram(test::params(1)), "127.0.0.1", port_of(*source));
  ipv4.send(test::datagram(test::params(2)), "127.0.0.1", port_of(*source));
  ipv6.send(test::datagram(test::params(3)), "::1", port_of(*source));
  EXPECT_EQ(next_counter(*source), 2u);
  EXPECT_EQ(next_counter(*source), 3u);
  EXPECT_EQ(source->statistics().refused, 1u);
}

TEST(UdpSource, OneBadDatagramLosesOnlyThatDatagram) {
  const auto source = open_source("udp://127.0.0.1:0?buffer=4000000");
  const PlainSocket good("127.0.0.2"), bad("127.0.0.3");
  std::mt19937 random(20240229);
  constexpr std::uint64_t rounds = 400;
  std::uint64_t good_received = 0, events = 0;
  Reception reception;
  for (std::uint64_t i = 0; i < rounds; ++i) {
    std::string broken = test::datagram(test::params(1'000'000 + i));
    switch (i % 5) {
      case 0:
        broken.clear();
        break;
      case 1:
        broken.resize(random() % broken.size());
        break;
      case 2:
        broken[random() % broken.size()] = static_cast<char>(random());
        break;
      case 3:
        broken.insert(random() % broken.size(), std::string(random() % 5000, static_cast<char>(random())));
        break;
      default:
        for (char& c : broken) c = static_cast<char>(random());
    }
    bad.send(broken, "127.0.0.1", port_of(*source));
    good.send(test::datagram(test::params(i)), "127.0.0.1", port_of(*source));
    for (int both = 0; both < 2; ++both) {
      const Event event = next(*source, reception);
      ASSERT_TRUE(event == Event::sample || event == Event::malformed);
      ++events;
      const std::uint8_t last_byte = reception.sample.sender.address[3];
      ASSERT_TRUE(last_byte == 2 || last_byte == 3) << "a malformed one also has its sender";
      if (last_byte == 2) {
        ASSERT_EQ(event, Event::sample);
        ASSERT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(i));
        ++good_received;
      }
    }
  }
  EXPECT_EQ(good_received, rounds);
  const auto s = source->statistics();
  EXPECT_EQ(s.records + s.malformed, events);
  EXPECT_GE(s.malformed, rounds / 5 * 2) << "the empty and the random ones at least";
  EXPECT_EQ(s.kernel_drops, 0u);
}

TEST(UdpSource, ATooLongDatagramIsReported) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  std::string padded = test::datagram(test::params(9));
  padded.pop_back();
  padded.resize(wire::max_datagram, ' ');
  tracker.send(padded, "127.0.0.1", port_of(*source));
  tracker.send(padded + " ", "127.0.0.1", port_of(*source));
  EXPECT_EQ(next_counter(*source), 9u) << "4096 bytes are allowed";
  Reception reception;
  ASSERT_EQ(next(*source, reception), Event::malformed);
  EXPECT_STREQ(reception.fault.name(), wire::name(wire::Reason::too_long));
  EXPECT_GT(reception.sample.arrival, 0);
}

TEST(UdpSource, ThreeCamerasOnOnePort) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  for (std::uint64_t counter = 0; counter < 5; ++counter) {
    for (std::uint32_t id = 1; id <= 3; ++id) {
      tracker.send(test::datagram(test::params(counter, id)), "127.0.0.1", port_of(*source));
    }
  }
  Reception reception;
  for (std::uint64_t counter = 0; counter < 5; ++counter) {
    for (std::uint32_t id = 1; id <= 3; ++id) {
      ASSERT_EQ(next(*source, reception), Event::sample);
      EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(counter, id));
    }
  }
}

TEST(UdpSource, EachSendersLayoutIsItsOwn) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket old_tracker("127.0.0.2"), new_tracker("127.0.0.3");
  const wire::WireForm document{wire::Encoding::binary, {wire::Generation::document}};
  const wire::WireForm identified{wire::Encoding::binary, {wire::Generation::identified}};
  const auto send = [&source](const PlainSocket& tracker, const std::string& datagram) {
    tracker.send(datagram, "127.0.0.1", port_of(*source));
  };
  // A matrix record without format bits is equal in both generations: only the constants distinguish them.
  wire::CameraParams p = test::params(5);
  p.format = 0;
  p.euler = {};
  p.matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1};
  send(old_tracker, test::datagram(test::constants(), document));
  send(new_tracker, test::datagram(test::constants(), identified));
  send(old_tracker, test::datagram(p, document));
  send(new_tracker, test::datagram(p, identified));
  send(old_tracker, test::datagram(p, document));
  Reception reception;
  for (const char* origin : {"binary document_lp64", "binary identified_lp64", "binary document_lp64",
                             "binary identified_lp64", "binary document_lp64"}) {
    ASSERT_EQ(next(*source, reception), Event::sample);
    EXPECT_STREQ(reception.sample.origin, origin);
  }
}

TEST(UdpSource, UnknownFormatBitsAreCountedAndKept) {
  const auto source = open_source("udp://127.0.0.1:0");
  const PlainSocket tracker;
  const std::string text = std::string("DMC01\0PA401 1 2 3 4 5 6 7 0 0 0 0 0 0 8", 39);
  tracker.send(text, "127.0.0.1", port_of(*source));
  tracker.send(test::datagram(test::params(9)), "127.0.0.1", port_of(*source));
  Reception reception;
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record).format, 0x401u);
  EXPECT_EQ(source->statistics().unknown_format_bits, 1u);
  EXPECT_EQ(next_counter(*source), 9u);
  EXPECT_EQ(source->statistics().unknown_format_bits, 1u);
}

TEST(UdpSource, APortInUseIsAnErrorThatNamesWhatCanBeShared) {
  const auto source = open_source("udp://127.0.0.1:0");
  const std::string url = "udp://127.0.0.1:" + std::to_string(port_of(*source));
  EXPECT_THAT(open_error(url), testing::AllOf(HasSubstr(url), HasSubstr("in use"), HasSubstr("multicast")));
  EXPECT_THAT(open_error("udp://:" + std::to_string(port_of(*source))), HasSubstr("in use"));
}

TEST(UdpSource, ABroadcastAddressIsShared) {
  const auto one = open_source("udp://127.255.255.255:0");
  const auto other = open_source("udp://127.255.255.255:" + std::to_string(port_of(*one)));
  const PlainSocket tracker;
  tracker.send(test::datagram(test::params(4)), "127.255.255.255", port_of(*one));
  EXPECT_EQ(next_counter(*one), 4u);
  EXPECT_EQ(next_counter(*other), 4u);
}

TEST(UdpSource, ReportsWhyItCannotBeOpened) {
  EXPECT_THAT(open_error("udp://127.0.0.1:0?interface=127.0.0.1"), HasSubstr("is for multicast"));
  EXPECT_THAT(open_error("udp://192.0.2.300:0"), HasSubstr("192.0.2.300"));
  EXPECT_THAT(open_error("udp://[ff02::7]:0"), HasSubstr("interface=ADDR"));
  EXPECT_THAT(open_error("udp://[fe80::7]:7000"), HasSubstr("%INTERFACE"));
  EXPECT_THAT(open_error("udp://[fe80::7%25sixteen_letters_]:7000"), HasSubstr("after %"));
  EXPECT_THAT(open_error("udp://[fe80::7%25nosuch0]:0"), testing::AllOf(HasSubstr("port = 0"), HasSubstr("nosuch0")));
}

/// The waiting_for of a source at `place` and some port.
std::string waiting_for(const std::string& place) { return open_source(place)->statistics().waiting_for; }

TEST(UdpSource, AMissingInterfaceIsWaitedFor) {
  EXPECT_THAT(waiting_for("udp://198.51.100.1:0"), HasSubstr(": no interface that is up has the address 198.51.100.1"));
  EXPECT_THAT(waiting_for("udp://239.255.77.1:0?interface=198.51.100.1"),
              testing::AllOf(HasSubstr("address or name 198.51.100.1;"), HasSubstr("there are"), HasSubstr("lo")));
  EXPECT_THAT(waiting_for("udp://239.255.77.1:0?interface=nosuch0"), HasSubstr("address or name nosuch0;"));
}

TEST(UdpSource, StatisticsWhileReceiving) {
  const auto source = open_source("udp://127.0.0.1:0?buffer=4000000");
  constexpr std::uint64_t sent = 2000;
  std::thread tracker([port = port_of(*source)] {
    const PlainSocket socket;
    for (std::uint64_t i = 0; i < sent; ++i) {
      socket.send(i % 4 == 3 ? std::string("garbage") : test::datagram(test::params(i)), "127.0.0.1", port);
    }
  });
  std::thread receiver([&source] {
    Reception reception;
    while (source->receive(reception, test::deadline) != Event::stopped) {
    }
  });
  // Every snapshot is consistent: three good ones before each bad one.
  const auto until = std::chrono::steady_clock::now() + test::deadline;
  SourceStatistics s;
  do {
    s = source->statistics();
    const bool bad_one_to_come = s.records % 3 == 0 && s.malformed + 1 == s.records / 3;
    ASSERT_TRUE(s.malformed == s.records / 3 || bad_one_to_come) << s.records << " and " << s.malformed;
  } while (s.records + s.malformed + s.kernel_drops < sent && std::chrono::steady_clock::now() < until);
  EXPECT_EQ(s.records, sent / 4 * 3);
  EXPECT_EQ(s.malformed, sent / 4);
  EXPECT_EQ(s.kernel_drops, 0u);
  source->stop();
  receiver.join();
  tracker.join();
}

}  // namespace trk_bridge::trk::udp_test
