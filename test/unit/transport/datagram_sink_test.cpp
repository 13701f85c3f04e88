// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A sink with a small test protocol: a record may become several datagrams or none; constants are repeated.
#include "transport/datagram.h"

#include <cerrno>
#include <deque>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/transport/source.h"
#include "udp.h"

namespace trk_bridge::transport::datagram_sink_test {

using test::PlainSocket;

/// Too large for a datagram: the system refuses to send it.
const std::string too_large(70'000, 'x');

/// The datagrams of a record, one string each.
struct Script {
  std::deque<std::string> params{"params"}, constants{"constants"};
  bool refuses_constants = false;
};

class Scripted final : public Encoder {
 public:
  explicit Scripted(const Script& script) : script_(script) {}

  tl::expected<void, Fault> begin(const wire::CameraParams&) noexcept override {
    left_ = script_.params;
    return {};
  }
  tl::expected<void, Fault> begin(const wire::CameraConstants&) noexcept override {
    if (script_.refuses_constants) return tl::make_unexpected(Fault(wire::Fault{wire::Reason::not_finite, 8, true}));
    left_ = script_.constants;
    return {};
  }
  std::optional<std::string_view> next() noexcept override {
    if (left_.empty()) return std::nullopt;
    given_ = left_.front();
    left_.pop_front();
    return given_;
  }

 private:
  const Script& script_;
  std::deque<std::string> left_;
  std::string given_;
};

class DatagramSinkTest : public testing::Test {
 protected:
  std::unique_ptr<Sink> open(double constants_period) {
    SendSettings settings;
    settings.host = "127.0.0.1";
    settings.port = receiver.port();
    settings.constants_period = constants_period;
    return open_datagram_sink(settings, std::make_unique<Scripted>(script));
  }
  /// The text of the next datagram; "nothing" if there is none. On the loopback a datagram has arrived when sending
  /// returns.
  std::string next() { return receiver.receive(std::chrono::milliseconds(0)).value_or("nothing"); }

  Script script;
  PlainSocket receiver;
};

constexpr double long_period = 86'400;  // s

TEST_F(DatagramSinkTest, SeveralDatagramsPerRecordInOrder) {
  script.params = {"one", "two", "three"};
  const auto sink = open(0);
  ASSERT_TRUE(sink->write(test::params(1)));
  for (const char* expected : {"one", "two", "three", "nothing"}) EXPECT_EQ(next(), expected);
  EXPECT_EQ(sink->statistics().params, 1u) << "records are counted, not datagrams";
}

TEST_F(DatagramSinkTest, ARecordThatTheProtocolDoesNotSendIsNotAnError) {
  script.constants.clear();
  const auto sink = open(0);
  ASSERT_TRUE(sink->write(test::constants()));
  EXPECT_EQ(next(), "nothing");
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(next(), "params");
}

TEST_F(DatagramSinkTest, ADatagramThatIsNotSentFailsItsRecordOnly) {
  script.params = {"one", too_large, "three"};
  const auto sink = open(0);
  const auto written = sink->write(test::params(1));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::system);
  EXPECT_EQ(written.error().error_number, EMSGSIZE);
  EXPECT_EQ(next(), "one");
  EXPECT_EQ(next(), "nothing");
  script.params = {"whole"};
  ASSERT_TRUE(sink->write(test::params(2)));
  EXPECT_EQ(next(), "whole");
  EXPECT_EQ(sink->statistics().params, 1u);
  EXPECT_EQ(sink->statistics().errors, 1u);
}

TEST_F(DatagramSinkTest, AllDatagramsOfConstantsAreRepeated) {
  script.constants = {"first half", "second half"};
  // A period so short that every write is later.
  const auto sink = open(1e-9);
  ASSERT_TRUE(sink->write(test::constants()));
  ASSERT_TRUE(sink->write(test::params(1)));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(next(), "first half");
    EXPECT_EQ(next(), "second half");
  }
  EXPECT_EQ(next(), "params");
  EXPECT_EQ(sink->statistics().constants, 2u);
}

TEST_F(DatagramSinkTest, ConstantsThatWereNotSentAreSentWithTheNextParameters) {
  const auto sink = open(long_period);
  script.constants = {too_large};
  EXPECT_FALSE(sink->write(test::constants()));
  script.constants = {"constants"};
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(next(), "constants");
  EXPECT_EQ(next(), "params");
  ASSERT_TRUE(sink->write(test::params(2)));
  EXPECT_EQ(next(), "params") << "their period has just started";
  EXPECT_EQ(sink->statistics().constants, 1u);
}

TEST_F(DatagramSinkTest, OtherConstantsThatWereNotSentDoNotWaitForThePeriodOfTheFirst) {
  const auto sink = open(long_period);
  ASSERT_TRUE(sink->write(test::constants(720)));
  EXPECT_EQ(next(), "constants");
  script.constants = {too_large};
  EXPECT_FALSE(sink->write(test::constants(1920)));
  script.constants = {"others"};
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(next(), "others");
  EXPECT_EQ(next(), "params");
}

TEST_F(DatagramSinkTest, AFailedRepetitionIsReportedAlthoughTheParametersWereSent) {
  const auto sink = open(1e-9);
  ASSERT_TRUE(sink->write(test::constants()));
  EXPECT_EQ(next(), "constants");
  script.constants = {too_large};
  const auto written = sink->write(test::params(1));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().error_number, EMSGSIZE);
  EXPECT_EQ(next(), "params");
  EXPECT_EQ(sink->statistics().constants, 1u);
  EXPECT_EQ(sink->statistics().params, 1u);
  EXPECT_EQ(sink->statistics().errors, 1u);
}

TEST_F(DatagramSinkTest, WithoutAPeriodConstantsAreSentOnlyWhenWritten) {
  const auto sink = open(0);
  script.constants = {too_large};
  EXPECT_FALSE(sink->write(test::constants()));
  script.constants = {"constants"};
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(next(), "params") << "the caller decides whether to write them again";
  ASSERT_TRUE(sink->write(test::constants()));
  EXPECT_EQ(next(), "constants");
  ASSERT_TRUE(sink->write(test::constants()));
  EXPECT_EQ(next(), "constants") << "the same ones, too";
}

TEST_F(DatagramSinkTest, ConstantsThatCannotBeEncodedAreNotRepeated) {
  const auto sink = open(1e-9);
  script.refuses_constants = true;
  const auto written = sink->write(test::constants());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().reason, SinkReason::not_encodable);
  EXPECT_EQ(describe(written.error().fault), "field 8 is not finite");
  script.refuses_constants = false;
  ASSERT_TRUE(sink->write(test::params(1)));
  EXPECT_EQ(next(), "params");
}

TEST_F(DatagramSinkTest, EachIdHasItsOwnConstants) {
  const auto sink = open(1e-9);
  ASSERT_TRUE(sink->write(test::constants(720, 1)));
  EXPECT_EQ(next(), "constants");
  ASSERT_TRUE(sink->write(test::params(1, 2)));
  EXPECT_EQ(next(), "params");
  ASSERT_TRUE(sink->write(test::params(1, 1)));
  EXPECT_EQ(next(), "constants");
  EXPECT_EQ(next(), "params");
}

TEST_F(DatagramSinkTest, APeriodOutOfRangeIsRefused) {
  for (const double period : {-1.0, 86'401.0}) EXPECT_THROW((void)open(period), TransportError) << period;
}

}  // namespace trk_bridge::transport::datagram_sink_test
