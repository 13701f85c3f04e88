// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trk detect, run like a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "camera_records.h"
#include "freed_messages.h"
#include "network_namespace.h"
#include "program.h"
#include "repeating.h"
#include "reserved_port.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/wire/codec.h"
#include "udp.h"

namespace trk_bridge::tools::detect_test {

using test::Program;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Result {
  std::map<std::string, nlohmann::json> by_source;
  std::string err;
  int exit_code = 0;
};

Result run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {TRK_TOOL, "detect", "--json", "--seconds", "2"});
  Program detect(std::move(arguments));
  Result result;
  while (const auto line = detect.out_line()) {
    auto camera = nlohmann::json::parse(*line);
    result.by_source[camera.at("source")] = camera;
  }
  result.err = detect.rest_of_err();
  result.exit_code = detect.wait();
  return result;
}

template <typename Record>
std::string trk_datagram(const Record& record) {
  wire::Buffer buffer;
  return std::string(wire::encode(record, wire::WireForm{}, buffer).value());
}

TEST(Detect, ReportsWhoSendsWhatToAPort) {
  const test::ReservedPort port;
  const test::PlainSocket tracker, head, other;
  const test::Repeating send(100, [&, round = std::uint64_t{0}]() mutable {
    const auto to = [&](const test::PlainSocket& from, const std::string& datagram) {
      from.send(datagram, "127.0.0.1", port.number());
    };
    if (round % 20 == 0) to(tracker, trk_datagram(test::constants(720, 3)));
    to(tracker, trk_datagram(test::params(round, 3)));
    std::string message = test::message_of(30, -5, 0, 7);
    message.back() = '\0';
    to(head, message);
    to(other, "hello");
    ++round;
  });
  const Result result = run({port.text()});
  EXPECT_EQ(result.exit_code, 0);
  ASSERT_EQ(result.by_source.size(), 2u) << result.err;

  const auto& trk = result.by_source.at("udp://:" + port.text());
  EXPECT_EQ(trk.at("protocol"), "trk");
  EXPECT_EQ(trk.at("sender"), "127.0.0.1:" + std::to_string(tracker.port()));
  EXPECT_EQ(trk.at("id"), 3);
  EXPECT_EQ(trk.at("encoding"), "ASCII");
  EXPECT_THAT(trk.at("format_words").get<std::string>(), HasSubstr("euler"));
  EXPECT_TRUE(trk.at("has_constants").get<bool>());
  EXPECT_GT(trk.at("records").get<int>(), 10);
  // At most a hundred a second are sent.
  EXPECT_GT(trk.at("rate").get<double>(), 5);
  EXPECT_LT(trk.at("rate").get<double>(), 101);
  EXPECT_NEAR(trk.at("pan")[0].get<double>(), 30, 1e-9);
  EXPECT_NEAR(trk.at("pan")[1].get<double>(), 30, 1e-9);
  EXPECT_EQ(trk.at("z"), nlohmann::json({1.75, 1.75}));
  EXPECT_THAT(trk.at("launch").get<std::string>(), HasSubstr("id:=3"));

  const auto& free_d = result.by_source.at("freed://:" + port.text() + "?checksum=lenient");
  EXPECT_EQ(free_d.at("protocol"), "Free-D");
  EXPECT_EQ(free_d.at("id"), 7);
  EXPECT_NEAR(free_d.at("pan")[0].get<double>(), -30, 1e-9) << "to the right";
  EXPECT_THAT(free_d.at("doubts").dump(), HasSubstr("wrong checksum"));

  EXPECT_THAT(result.err, HasSubstr("datagrams from 127.0.0.1:" + std::to_string(other.port()) +
                                    ", unknown protocol (the last one has 5 bytes: 68 65 6c 6c 6f)"));
  EXPECT_THAT(result.err, Not(HasSubstr("Free-D with a fault")));
}

/// What is detected if one of `of` messages has a right checksum and the others a wrong one; with `right` false, the
/// reverse. By the options of the source.
std::map<std::string, nlohmann::json> heads_found(std::uint64_t of, bool right) {
  const test::ReservedPort port;
  const test::PlainSocket head;
  const test::Repeating send(100, [&, round = std::uint64_t{0}]() mutable {
    std::string message = test::message_of(30, -5, 0, 7);
    if ((round % of == 0) != right) message.back() = static_cast<char>(message.back() + 1);
    head.send(message, "127.0.0.1", port.number());
    ++round;
  });
  std::map<std::string, nlohmann::json> found;
  for (const auto& [source, camera] : run({port.text()}).by_source)
    found[source.substr(source.rfind(':') + 6)] = camera;
  return found;
}

TEST(Detect, TheReadingThatAcceptsMoreIsUsed) {
  const auto mostly_wrong = heads_found(5, true);
  ASSERT_EQ(mostly_wrong.size(), 1u);
  EXPECT_EQ(mostly_wrong.begin()->first, "?checksum=lenient");
  EXPECT_THAT(mostly_wrong.begin()->second.at("doubts").dump(), Not(HasSubstr("also sends")))
      << "freed with checksum=lenient also reads the others";
  const auto mostly_right = heads_found(5, false);
  ASSERT_EQ(mostly_right.size(), 1u);
  EXPECT_EQ(mostly_right.begin()->first, "");
  EXPECT_THAT(mostly_right.begin()->second.at("doubts").dump(), HasSubstr("only checksum=lenient accepts"));
}

TEST(Detect, AMessageThatCannotBeReadIsNamedWithItsProtocol) {
  const test::ReservedPort port;
  const test::PlainSocket head;
  const test::Repeating send(100, [&] {
    std::string message = test::message_of(30, -5, 0, 7);
    message.front() = '\xD2';
    head.send(message, "127.0.0.1", port.number());
  });
  const Result result = run({port.text()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("Free-D with a fault: Free-D message D2"), HasSubstr("nothing was found")));
}

/// In a private network, because it uses the standard port.
TEST(Detect, FindsGroupsAmongTheUsualPorts) {
  std::optional<test::NetworkNamespace> network;
  try {
    network.emplace();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  const test::NetworkNamespace::Stay stay(*network);
  const auto group = endpoints::open_sink("opentrackio://?source=200&interface=127.0.0.1");
  const auto unicast = endpoints::open_sink("opentrackio://127.0.0.1");
  const test::Repeating send(100, [&, round = std::uint64_t{0}]() mutable {
    (void)group->write(test::params(round, 200));
    (void)unicast->write(test::params(round, 4));
    ++round;
  });
  const Result result = run({});
  EXPECT_EQ(result.exit_code, 0);
  ASSERT_EQ(result.by_source.size(), 2u) << result.err;
  EXPECT_EQ(result.by_source.at("opentrackio://239.135.1.200:55555").at("id"), 200);
  EXPECT_EQ(result.by_source.at("opentrackio://:55555").at("id"), 4);
  EXPECT_THAT(result.err, Not(HasSubstr("cannot listen")));
  EXPECT_THAT(result.err, HasSubstr(" 40000 "));
}

TEST(Detect, WithoutResultItListsWhatToCheck) {
  const test::ReservedPort port;
  const Result result = run({port.text()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.by_source, IsEmpty());
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("nothing was found"), HasSubstr("tcpdump"), HasSubstr("firewall"), HasSubstr("IGMP")));
}

TEST(Detect, APortOfAnotherProgramIsNotUsed) {
  const test::PlainSocket owner;
  const Result result = run({std::to_string(owner.port())});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("cannot listen"), HasSubstr("the port is in use")));
}

TEST(Detect, InvalidPortsAreRefused) {
  for (const std::string port : {"0", "70000", "udp", "host:", "239.1.1.1:0"}) {
    const Result result = run({port});
    EXPECT_EQ(result.exit_code, 2) << port;
    EXPECT_THAT(result.err, HasSubstr("PORT = \"" + port + "\": must be 1 to 65535")) << port;
  }
}

TEST(Detect, ListsTheUsualPlaces) {
  Program list({TRK_TOOL, "detect", "--list"});
  const std::string text = list.rest_of_out();
  EXPECT_EQ(list.wait(), 0);
  EXPECT_THAT(text, AllOf(HasSubstr("60005  trk"), HasSubstr("1111  Free-D  Panasonic"),
                          HasSubstr("239.135.1.1 to 239.135.1.200"), HasSubstr("235.135.1.1 to 235.135.1.200")));
}

}  // namespace trk_bridge::tools::detect_test
