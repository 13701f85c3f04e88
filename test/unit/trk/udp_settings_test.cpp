// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk/udp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "url_errors.h"

namespace trk_bridge::trk::udp_settings_test {

using test::read_error;
using test::write_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

UdpSourceSettings udp_in(const std::string& url) {
  const auto settings = udp_source_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(UdpSourceSettings{});
}
UdpSinkSettings udp_out(const std::string& url) {
  const auto settings = udp_sink_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(UdpSinkSettings{});
}

TEST(UdpSettings, UdpHostsAndPorts) {
  EXPECT_EQ(udp_in("udp://:7000").host, "");
  EXPECT_EQ(udp_in("udp://:7000").port, 7000);
  EXPECT_EQ(udp_in("udp://0.0.0.0:7000").host, "0.0.0.0");
  EXPECT_EQ(udp_in("udp://[::]:7000").host, "::");
  EXPECT_EQ(udp_in("udp://[fe80::1%25eth0]:7000").host, "fe80::1%eth0");
  EXPECT_EQ(udp_in("udp://tracker-3.studio:65535").host, "tracker-3.studio");
  EXPECT_EQ(udp_in("udp://tracker-3.studio:65535").port, 65535);
  EXPECT_EQ(udp_in("udp://127.0.0.1:0").port, 0) << "reading, the kernel may pick the port";
}

TEST(UdpSettings, UdpReadingOptions) {
  const auto e = udp_in(
      "udp://239.1.2.3:7000?interface=127.0.0.1&allow=192.0.2.1,[::1],host&buffer=4194304&layout=document_i386_be");
  EXPECT_EQ(e.host, "239.1.2.3");
  EXPECT_EQ(e.interface, "127.0.0.1");
  EXPECT_THAT(e.allow, ElementsAre("192.0.2.1", "::1", "host"));
  EXPECT_EQ(e.buffer, 4194304);
  EXPECT_EQ(e.layout.generation, wire::Generation::document);
  EXPECT_EQ(e.layout.abi, wire::Abi::i386);
  EXPECT_EQ(e.layout.byte_order, wire::ByteOrder::big);
}

TEST(UdpSettings, UdpWritingOptions) {
  const auto e = udp_out("udp://[ff15::7]:7000?binary=1&layout=identified&ttl=0&interface=eth0&constants_period=2.5");
  EXPECT_EQ(e.host, "ff15::7");
  EXPECT_TRUE(e.binary);
  EXPECT_EQ(e.layout.generation, wire::Generation::identified);
  EXPECT_FALSE(e.layout.abi.has_value());
  EXPECT_EQ(e.ttl, 0);
  EXPECT_EQ(e.interface, "eth0");
  EXPECT_EQ(e.constants_period, 2.5);
}

TEST(UdpSettings, UdpDefaults) {
  const auto in = udp_in("udp://:7000");
  EXPECT_TRUE(in.allow.empty());
  EXPECT_FALSE(in.buffer.has_value());
  EXPECT_FALSE(in.layout.generation.has_value());
  const auto out = udp_out("udp://192.0.2.7:7000");
  EXPECT_FALSE(out.binary);
  EXPECT_FALSE(out.ttl.has_value());
  EXPECT_EQ(out.constants_period, 1.0);
}

TEST(UdpSettings, UdpWrongHostsAndPorts) {
  EXPECT_THAT(read_error("udp://"), HasSubstr("no port"));
  EXPECT_THAT(read_error("udp://host"), AllOf(HasSubstr("udp://host"), HasSubstr("no port")));
  EXPECT_THAT(read_error("udp://:"), AllOf(HasSubstr("port = \"\""), HasSubstr("0 to 65535")));
  EXPECT_THAT(read_error("udp://:65536"), HasSubstr("port = \"65536\""));
  EXPECT_THAT(read_error("udp://:-1"), HasSubstr("port = \"-1\""));
  EXPECT_THAT(read_error("udp://:7000x"), HasSubstr("port = \"7000x\""));
  EXPECT_THAT(read_error("udp://:7000/"), HasSubstr("port = \"7000/\""));
  EXPECT_THAT(read_error("udp://::1:7000"), HasSubstr("[::1]:7000"));
  EXPECT_THAT(read_error("udp://[::1:7000"), HasSubstr("["));
  EXPECT_THAT(read_error("udp://[::1]7000"), HasSubstr("nothing after the port"));
  for (const std::string wrong : {"a b:7000", "a%20b:7000", "a/b:7000", "a%2Fb:7000", "a[b:7000", "a%5Bb:7000"}) {
    EXPECT_THAT(read_error("udp://" + wrong), HasSubstr("host \"" + wrong + "\": a name")) << wrong;
  }
  EXPECT_THAT(read_error("udp:7000"), HasSubstr("udp://HOST:PORT"));
  EXPECT_THAT(write_error("udp://:7000"), HasSubstr("no host"));
  EXPECT_THAT(write_error("udp://host:0"), HasSubstr("1 to 65535"));
}

TEST(UdpSettings, AnInvalidInterfaceNameIsAnErrorAtOnce) {
  for (const std::string good : {"eth0", "enp0s31f6.100", "192.0.2.9", "fe80::1", "fe80::1%25eth0"}) {
    EXPECT_NE(udp_in("udp://239.1.2.3:7000?interface=" + good).interface, "") << good;
  }
  for (const std::string bad :
       {"", "192.0.2.300", "192.0.2", "192.0.2.9.", "fe80::x", "eth0:7000", "a/b", "sixteen_letters_"}) {
    EXPECT_THAT(read_error("udp://239.1.2.3:7000?interface=" + bad),
                AllOf(HasSubstr("option interface = \"" + bad + "\""), HasSubstr("an interface's name")));
    EXPECT_THAT(write_error("udp://239.1.2.3:7000?interface=" + bad), HasSubstr("option interface"));
  }
}

TEST(UdpSettings, ALayoutWithoutBinaryIsRefused) {
  EXPECT_THAT(write_error("udp://h:1?layout=identified"), HasSubstr("binary=1"));
  EXPECT_THAT(write_error("udp://h:1?layout=identified&binary=0"), HasSubstr("binary=1"));
}

}  // namespace trk_bridge::trk::udp_settings_test
