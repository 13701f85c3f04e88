// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A source with a small test protocol: the possible results of a datagram.
#include "transport/datagram.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "udp.h"

namespace trk_bridge::transport::datagram_source_test {

using test::next;
using test::next_counter;
using test::PlainSocket;
using test::port_of;
using testing::ElementsAre;

constexpr auto no_wait = std::chrono::nanoseconds::zero();

std::string describe_letter(const Fault& fault) {
  return std::string("letter ") + static_cast<char>(fault.code()) + " at " + std::to_string(fault.field());
}

/// A digit is a sample with that counter, a blank is ignored, everything else is a fault.
class Digits final : public Decoder {
 public:
  explicit Digits(std::vector<std::string>& begun) : begun_(begun) {}

  void begin(std::string_view datagram, const Sender&) noexcept override {
    begun_.emplace_back(datagram);
    datagram_ = datagram;
    at_ = 0;
  }
  Next next(Sample& into, Fault& fault) noexcept override {
    while (at_ < datagram_.size() && datagram_[at_] == ' ') ++at_;
    if (at_ == datagram_.size()) return Next::none;
    const std::size_t at = at_++;
    const char c = datagram_[at];
    if (c < '0' || c > '9') {
      fault = Fault("letter", describe_letter, static_cast<std::uint8_t>(c), static_cast<std::int16_t>(at));
      return Next::fault;
    }
    into.record = test::params(static_cast<std::uint64_t>(c - '0'));
    into.origin = "digits";
    into.has_lens = false;
    return Next::sample;
  }

 private:
  std::vector<std::string>& begun_;
  std::string_view datagram_;
  std::size_t at_ = 0;
};

class DatagramSourceTest : public testing::Test {
 protected:
  std::unique_ptr<Source> open(const std::vector<std::string>& allow = {}) {
    ReceiveSettings settings;
    settings.host = "127.0.0.1";
    settings.allow = allow;
    return open_datagram_source(settings, std::make_unique<Digits>(begun));
  }
  void send(const Source& to, const std::string& datagram) { tracker.send(datagram, "127.0.0.1", port_of(to)); }

  std::vector<std::string> begun;  // the datagrams that the decoder was given
  PlainSocket tracker{"127.0.0.5"};
  Reception reception;
};

TEST_F(DatagramSourceTest, OneSamplePerDatagram) {
  const auto source = open();
  send(*source, "7");
  ASSERT_EQ(next(*source, reception), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record).counter, 7u);
  EXPECT_STREQ(reception.sample.origin, "digits");
  EXPECT_FALSE(reception.sample.has_lens) << "as the decoder reported";
  EXPECT_EQ(to_string(reception.sample.sender), "127.0.0.5:" + std::to_string(tracker.port()));
  EXPECT_EQ(source->receive(reception, no_wait), Event::idle);
}

TEST_F(DatagramSourceTest, SeveralSamplesPerDatagramShareArrivalAndSender) {
  const auto source = open();
  send(*source, "123");
  send(*source, "4");
  std::int64_t arrival = 0;
  for (std::uint64_t counter = 1; counter <= 3; ++counter) {
    reception.sample.sender = {};
    reception.sample.arrival = 0;
    ASSERT_EQ(source->receive(reception, no_wait), Event::sample) << "available records need no wait";
    EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record).counter, counter);
    EXPECT_EQ(reception.sample.sender.number, tracker.port());
    if (counter == 1) arrival = reception.sample.arrival;
    EXPECT_GT(reception.sample.arrival, 0);
    EXPECT_EQ(reception.sample.arrival, arrival);
  }
  EXPECT_EQ(next_counter(*source), 4u);
  EXPECT_EQ(source->statistics().records, 4u);
  EXPECT_THAT(begun, ElementsAre("123", "4"));
}

TEST_F(DatagramSourceTest, ADatagramWithoutSamplesIsSkipped) {
  const auto source = open();
  send(*source, "  ");
  EXPECT_EQ(source->receive(reception, no_wait), Event::idle);
  send(*source, "");
  send(*source, " ");
  send(*source, "5");
  EXPECT_EQ(next_counter(*source), 5u);
  EXPECT_EQ(source->statistics().records, 1u);
  EXPECT_EQ(source->statistics().malformed, 0u) << "it is no fault";
  EXPECT_EQ(begun.size(), 4u);
}

TEST_F(DatagramSourceTest, AFaultInTheMiddleLosesOnlyThatRecord) {
  const auto source = open();
  send(*source, "1x2");
  EXPECT_EQ(next_counter(*source), 1u);
  ASSERT_EQ(next(*source, reception), Event::malformed);
  EXPECT_EQ(describe(reception.fault), "letter x at 1");
  EXPECT_EQ(reception.sample.sender.number, tracker.port());
  EXPECT_GT(reception.sample.arrival, 0);
  EXPECT_EQ(next_counter(*source), 2u);
  EXPECT_EQ(source->receive(reception, no_wait), Event::idle);
  EXPECT_EQ(source->statistics().records, 2u);
  EXPECT_EQ(source->statistics().malformed, 1u);
}

TEST_F(DatagramSourceTest, StopHasPriorityOverTheRestOfADatagram) {
  const auto source = open();
  send(*source, "12");
  EXPECT_EQ(next_counter(*source), 1u);
  source->stop();
  EXPECT_EQ(next(*source, reception), Event::stopped);
}

TEST_F(DatagramSourceTest, TheDecoderNeverSeesRefusedSendersAndTooLongDatagrams) {
  const auto source = open({"127.0.0.5"});
  const PlainSocket stranger("127.0.0.6");
  stranger.send("1", "127.0.0.1", port_of(*source));
  send(*source, std::string(wire::max_datagram + 1, '2'));
  send(*source, "3");
  ASSERT_EQ(next(*source, reception), Event::malformed);
  EXPECT_EQ(reception.fault, Fault(wire::Fault{wire::Reason::too_long}));
  EXPECT_EQ(next_counter(*source), 3u);
  EXPECT_THAT(begun, ElementsAre("3"));
  EXPECT_EQ(source->statistics().refused, 1u);
}

TEST_F(DatagramSourceTest, AsManySamplesAsADatagramHolds) {
  const auto source = open();
  send(*source, std::string(wire::max_datagram, '9'));
  send(*source, "1");
  for (std::size_t i = 0; i < wire::max_datagram; ++i) ASSERT_EQ(next_counter(*source), 9u) << i;
  EXPECT_EQ(next_counter(*source), 1u);
}

}  // namespace trk_bridge::transport::datagram_source_test
