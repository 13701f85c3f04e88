// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The UDP sink with plain sockets on the loopback.
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error_of.h"
#include "udp.h"

namespace trk_bridge::trk::udp_sink_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::PlainSocket;
using test::port_of;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::SinkReason;
using transport::TransportError;

std::string url_to(const PlainSocket& receiver, const std::string& options = "") {
  return "udp://127.0.0.1:" + std::to_string(receiver.port()) + options;
}

std::string open_error(const std::string& url) {
  return test::error_of<TransportError>([&] { (void)open_sink(url); });
}

bool is_constants(const std::string& datagram) { return datagram.size() > 6 && datagram[6] == 'C'; }

TEST(UdpSink, AsciiToOneAddress) {
  const PlainSocket receiver;
  const auto sink = open_sink(url_to(receiver));
  ASSERT_TRUE(sink->write(test::params(7, 2)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::params(7, 2)));
  EXPECT_EQ(sink->statistics().params, 1u);
  EXPECT_EQ(sink->name(), "udp to 127.0.0.1:" + std::to_string(receiver.port()));
}

TEST(UdpSink, Ipv6) {
  const PlainSocket receiver("::1");
  const auto sink = open_sink("udp://[::1]:" + std::to_string(receiver.port()));
  ASSERT_TRUE(sink->write(test::params(7)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::params(7)));
}

TEST(UdpSink, AHostNameIsLookedUp) {
  const PlainSocket receiver;
  const auto sink = open_sink("udp://localhost:" + std::to_string(receiver.port()));
  ASSERT_TRUE(sink->write(test::params(7)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::params(7)));
}

TEST(UdpSink, BinaryIsTheCommonLayoutByDefault) {
  const PlainSocket receiver;
  const auto usual = open_sink(url_to(receiver, "?binary=1"));
  ASSERT_TRUE(usual->write(test::constants()));
  EXPECT_EQ(receiver.receive()->size(), 8u + 64u) << "identified, LP64";
  const auto document = open_sink(url_to(receiver, "?binary=1&layout=document_i386_be"));
  ASSERT_TRUE(document->write(test::params(0x01020304)));
  const auto datagram = receiver.receive();
  ASSERT_EQ(datagram->size(), 8u + 192u);
  EXPECT_EQ(datagram->substr(0, 12), std::string("DMC01\0PB\0\0\0\1", 12));
  EXPECT_EQ(datagram->substr(8 + 188), "\1\2\3\4");
}

TEST(UdpSink, EveryWriteOfConstantsIsSent) {
  const PlainSocket receiver;
  const auto sink = open_sink(url_to(receiver, "?constants_period=0"));
  ASSERT_TRUE(sink->write(test::constants(720)));
  ASSERT_TRUE(sink->write(test::constants(720)));
  for (std::uint64_t i = 0; i < 50; ++i) ASSERT_TRUE(sink->write(test::params(i)));
  ASSERT_TRUE(sink->write(test::constants(1920)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::constants(720)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::constants(720))) << "the caller decides whether they are new";
  for (std::uint64_t i = 0; i < 50; ++i) ASSERT_EQ(receiver.receive(), test::datagram(test::params(i)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::constants(1920)));
  EXPECT_EQ(sink->statistics().constants, 3u);
  EXPECT_EQ(sink->statistics().params, 50u);
}

TEST(UdpSink, ConstantsAreRepeatedNotBeforeTheirPeriod) {
  const PlainSocket receiver;
  const auto sink = open_sink(url_to(receiver, "?constants_period=0.03"));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(sink->write(test::constants(720)));
  std::uint64_t constants_seen = 0, params_seen = 0, counter = 0;
  while (constants_seen < 4 && std::chrono::steady_clock::now() < begin + test::deadline) {
    ASSERT_TRUE(sink->write(test::params(counter++)));
    while (const auto datagram = receiver.receive(std::chrono::milliseconds(0))) {
      ++(is_constants(*datagram) ? constants_seen : params_seen);
    }
  }
  EXPECT_EQ(constants_seen, 4u);
  EXPECT_EQ(params_seen, counter);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(90)) << "three periods";
}

TEST(UdpSink, RepeatedConstantsComeBeforeTheParamsOfTheirCamera) {
  const PlainSocket receiver;
  // A period so short that every write is later.
  const auto sink = open_sink(url_to(receiver, "?constants_period=1e-9"));
  ASSERT_TRUE(sink->write(test::constants(720, 1)));
  ASSERT_TRUE(sink->write(test::constants(1920, 2)));
  ASSERT_TRUE(sink->write(test::params(5, 2)));
  ASSERT_TRUE(sink->write(test::params(5, 3)));
  ASSERT_TRUE(sink->write(test::params(5, 1)));
  for (const std::string& expected : {test::datagram(test::constants(720, 1)), test::datagram(test::constants(1920, 2)),
                                      test::datagram(test::constants(1920, 2)), test::datagram(test::params(5, 2)),
                                      test::datagram(test::params(5, 3)), test::datagram(test::constants(720, 1)),
                                      test::datagram(test::params(5, 1))}) {
    EXPECT_EQ(receiver.receive(), expected);
  }
}

TEST(UdpSink, ALateReceiverGetsTheConstants) {
  auto source = open_source("udp://127.0.0.1:0");
  const std::string place = "udp://127.0.0.1:" + std::to_string(port_of(*source));
  const auto sink = open_sink(place + "?constants_period=0.02");
  source.reset();
  ASSERT_TRUE(sink->write(test::constants(720)));
  ASSERT_TRUE(sink->write(test::params(1)));
  source = open_source(place);
  Reception reception;
  bool learned = false;
  const auto until = std::chrono::steady_clock::now() + test::deadline;
  for (std::uint64_t i = 2; !learned && std::chrono::steady_clock::now() < until; ++i) {
    ASSERT_TRUE(sink->write(test::params(i)));
    while (source->receive(reception, std::chrono::nanoseconds::zero()) == Event::sample) {
      const auto* constants = std::get_if<wire::CameraConstants>(&reception.sample.record);
      if (constants == nullptr) continue;
      EXPECT_EQ(*constants, test::constants(720));
      learned = true;
    }
  }
  EXPECT_TRUE(learned);
}

TEST(UdpSink, AMissingReceiverDoesNotAffectALaterOne) {
  auto source = open_source("udp://127.0.0.1:0");
  const std::string place = "udp://127.0.0.1:" + std::to_string(port_of(*source));
  const auto sink = open_sink(place);
  source.reset();
  for (std::uint64_t i = 0; i < 20; ++i) ASSERT_TRUE(sink->write(test::params(i)));
  source = open_source(place);
  ASSERT_TRUE(sink->write(test::params(20)));
  EXPECT_EQ(test::next_counter(*source), 20u) << "the first one after it arrived";
  EXPECT_EQ(sink->statistics().errors, 0u);
}

TEST(UdpSink, OnlyARecordThatCannotBeEncodedIsLost) {
  const PlainSocket receiver;
  const auto sink = open_sink(url_to(receiver));
  auto bad = test::params(1);
  bad.euler.pan = std::nan("");
  const auto written = sink->write(bad);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::not_encodable);
  EXPECT_STREQ(written.error().fault.name(), wire::name(wire::Reason::not_finite));
  EXPECT_EQ(written.error().fault.field(), 5) << "format, x, y, z, pan";
  EXPECT_THAT(describe(written.error()), HasSubstr(describe(written.error().fault)));
  auto bad_constants = test::constants();
  bad_constants.chip_width = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(sink->write(bad_constants));
  ASSERT_TRUE(sink->write(test::params(2)));
  EXPECT_EQ(receiver.receive(), test::datagram(test::params(2))) << "and the bad constants are not repeated";
  EXPECT_EQ(sink->statistics().errors, 2u);
  EXPECT_EQ(sink->statistics().params, 1u);
}

TEST(UdpSink, AfterCloseNothingIsSent) {
  const PlainSocket receiver;
  const auto sink = open_sink(url_to(receiver));
  ASSERT_TRUE(sink->close());
  ASSERT_TRUE(sink->close());
  EXPECT_EQ(sink->write(test::params(1)).error().reason, SinkReason::closed);
  EXPECT_EQ(sink->write(test::constants()).error().reason, SinkReason::closed);
  EXPECT_EQ(sink->statistics().errors, 2u);
}

TEST(UdpSink, TheTtlIsSet) {
  const PlainSocket receiver;
  const int yes = 1;
  ASSERT_EQ(::setsockopt(receiver.fd(), IPPROTO_IP, IP_RECVTTL, &yes, sizeof yes), 0);
  const auto sink = open_sink(url_to(receiver, "?ttl=7"));
  ASSERT_TRUE(sink->write(test::params(1)));
  char data[512];
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))];
  iovec part{data, sizeof data};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  ASSERT_GT(::recvmsg(receiver.fd(), &header, MSG_DONTWAIT), 0);
  const cmsghdr* c = CMSG_FIRSTHDR(&header);
  ASSERT_NE(c, nullptr);
  int ttl = 0;
  std::memcpy(&ttl, CMSG_DATA(c), sizeof ttl);
  EXPECT_EQ(ttl, 7);
  EXPECT_THAT(open_error(url_to(receiver, "?ttl=0")), HasSubstr("ttl"));
}

TEST(UdpSink, BroadcastNeedsNoOption) {
  const auto source = open_source("udp://0.0.0.0:0");
  const auto sink = open_sink("udp://127.255.255.255:" + std::to_string(port_of(*source)));
  ASSERT_TRUE(sink->write(test::params(3)));
  EXPECT_EQ(test::next_counter(*source), 3u);
}

TEST(UdpSink, ReportsWhyItCannotBeOpened) {
  EXPECT_THAT(open_error("udp://0.0.0.0:7000"), HasSubstr("not an address to send to"));
  EXPECT_THAT(open_error("udp://[::]:7000"), HasSubstr("udp://[::]:7000: host"));
  EXPECT_THAT(open_error("udp://127.0.0.1:7000?interface=127.0.0.1"), HasSubstr("is for multicast"));
}

TEST(UdpSink, AMissingInterfaceIsAFaultOfEachWrite) {
  const auto sink = open_sink("udp://239.255.77.1:7000?interface=nosuch0");
  EXPECT_EQ(sink->name(), "udp to 239.255.77.1:7000 through nosuch0");
  EXPECT_EQ(sink->write(test::params(1)).error().reason, SinkReason::no_interface) << "and not the system's choice";
  EXPECT_EQ(sink->statistics().errors, 1u);
}

}  // namespace trk_bridge::trk::udp_sink_test
