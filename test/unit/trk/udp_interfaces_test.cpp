// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Names and addresses that move to another interface, and other interfaces that are added and removed.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "two_machines.h"

namespace trk_bridge::trk::udp_interfaces_test {

/// A second cable, from w0 to w1, without addresses.
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
  while (through_v.receives(std::chrono::milliseconds(0))) {
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

}  // namespace trk_bridge::trk::udp_interfaces_test
