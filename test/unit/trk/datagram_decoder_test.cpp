// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk/datagram_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "udp.h"

namespace trk_bridge::trk::datagram_decoder_test {

using testing::StartsWith;
using transport::Fault;
using transport::Sample;
using transport::Sender;
using transport::SenderKind;
using Next = transport::Decoder::Next;

Sender sender(std::uint32_t port) { return {SenderKind::ipv4, {192, 0, 2, 7}, port}; }

constexpr wire::WireForm document{wire::Encoding::binary, {wire::Generation::document}};
constexpr wire::WireForm identified{wire::Encoding::binary, {wire::Generation::identified}};

/// A matrix that is valid in both generations: the id of one is the format of the other.
std::string ambiguous() {
  wire::CameraParams p;
  p.matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1};
  p.id = 2;
  p.counter = 5;
  return test::datagram(p, identified);
}

/// The first result of the datagram; there may be only one.
Next first_of(DatagramDecoder& decoder, const std::string& datagram, const Sender& from, Sample& sample, Fault& fault) {
  decoder.begin(datagram, from);
  const Next next = decoder.next(sample, fault);
  Sample unused;
  Fault no_fault;
  EXPECT_EQ(decoder.next(unused, no_fault), Next::none);
  return next;
}

/// The encoding of the datagram, or its fault.
std::string origin_of(DatagramDecoder& decoder, const std::string& datagram, const Sender& from) {
  Sample sample;
  Fault fault;
  return first_of(decoder, datagram, from, sample, fault) == Next::sample ? sample.origin : fault.name();
}

TEST(DatagramDecoder, OneSamplePerDatagram) {
  DatagramDecoder decoder({});
  Sample sample;
  Fault fault;
  EXPECT_EQ(decoder.next(sample, fault), Next::none) << "nothing was started";
  sample.has_counter = sample.has_lens = false;
  sample.sample_time = 5;
  sample.time_code = base::TimeCodeWithRate{};
  sample.arrival = 7;
  sample.encoders.zoom = 5;
  sample.doubt = "of another";
  ASSERT_EQ(first_of(decoder, test::datagram(test::params(12, 3)), sender(1), sample, fault), Next::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(sample.record), test::params(12, 3));
  EXPECT_STREQ(sample.origin, "ASCII");
  EXPECT_TRUE(sample.has_counter && sample.has_lens);
  EXPECT_EQ(sample.encoders, transport::LensEncoders{});
  EXPECT_STREQ(sample.doubt, "");
  EXPECT_FALSE(sample.sample_time || sample.time_code) << "trk has no time";
  EXPECT_EQ(sample.arrival, 7) << "only the socket knows it";
}

TEST(DatagramDecoder, AFaultHasAReason) {
  DatagramDecoder decoder({});
  Sample sample;
  Fault fault;
  ASSERT_EQ(first_of(decoder, "invalid data", sender(1), sample, fault), Next::fault);
  EXPECT_STREQ(fault.name(), wire::name(wire::Reason::bad_magic));
  EXPECT_EQ(origin_of(decoder, test::datagram(test::params(1)), sender(1)), "ASCII") << "the next datagram is good";
}

TEST(DatagramDecoder, RemembersTheLayoutOfASender) {
  DatagramDecoder decoder({});
  EXPECT_EQ(origin_of(decoder, test::datagram(test::constants(), document), sender(1)), "binary document_lp64");
  EXPECT_EQ(origin_of(decoder, test::datagram(test::constants(), identified), sender(2)), "binary identified_lp64");
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(1)), "binary document_lp64");
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(2)), "binary identified_lp64");
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(1)), "binary document_lp64");
}

TEST(DatagramDecoder, AGivenLayoutIsUsedForAll) {
  DatagramDecoder decoder({wire::Generation::document, {}, {}});
  EXPECT_THAT(origin_of(decoder, ambiguous(), sender(1)), StartsWith("binary document_lp64"));
  EXPECT_THAT(origin_of(decoder, ambiguous(), sender(2)), StartsWith("binary document_lp64"));
}

TEST(DatagramDecoder, AGuessedLayoutIsMarked) {
  DatagramDecoder decoder({});
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(1)), "binary identified_lp64, layout guessed");
}

TEST(DatagramDecoder, TheSenderThatIsSilentLongestIsReplaced) {
  DatagramDecoder decoder({});
  for (std::uint32_t port = 0; port < DatagramDecoder::capacity; ++port) {
    ASSERT_EQ(origin_of(decoder, test::datagram(test::constants(), document), sender(port)), "binary document_lp64");
  }
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(0)), "binary document_lp64");
  ASSERT_EQ(origin_of(decoder, test::datagram(test::constants(), document), sender(1000)), "binary document_lp64");
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(0)), "binary document_lp64") << "it was received after 1";
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(1000)), "binary document_lp64");
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(1)), "binary identified_lp64, layout guessed") << "forgotten";
}

TEST(DatagramDecoder, InvalidDataReplaceNoSender) {
  DatagramDecoder decoder({});
  ASSERT_EQ(origin_of(decoder, test::datagram(test::constants(), document), sender(0)), "binary document_lp64");
  for (std::uint32_t port = 1; port <= 10 * DatagramDecoder::capacity; ++port) {
    EXPECT_EQ(origin_of(decoder, "invalid data", sender(port)), wire::name(wire::Reason::bad_magic));
  }
  EXPECT_EQ(origin_of(decoder, ambiguous(), sender(0)), "binary document_lp64");
}

}  // namespace trk_bridge::trk::datagram_decoder_test
