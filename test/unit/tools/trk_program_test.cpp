// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The programs, run like a user does.
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "program.h"
#include "temporary_directory.h"
#include "transport/socket.h"
#include "trk_bridge/transport/source.h"
#include "udp.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::tools::trk_program_test {

using test::Program;
using testing::HasSubstr;

/// A line of `trk dump --json` back as a record.
wire::CameraParams params_of_json(const rapidjson::Value& v) {
  wire::CameraParams p;
  p.id = v["id"].GetUint();
  p.format = v["format"].GetUint();
  p.counter = v["counter"].GetUint64();
  if (v.HasMember("matrix")) {
    for (rapidjson::SizeType i = 0; i < 16; ++i) p.matrix[i] = v["matrix"][i].GetDouble();
  } else {
    const auto& e = v["euler"];
    p.euler = {e["x"].GetDouble(),   e["y"].GetDouble(),    e["z"].GetDouble(),
               e["pan"].GetDouble(), e["tilt"].GetDouble(), e["roll"].GetDouble()};
  }
  p.fov = v["fov"].GetDouble();
  p.center_x = v["center_x"].GetDouble();
  p.center_y = v["center_y"].GetDouble();
  p.k1 = v["k1"].GetDouble();
  p.k2 = v["k2"].GetDouble();
  p.focdist = v["focdist"].GetDouble();
  p.aperture = v["aperture"].GetDouble();
  return p;
}

rapidjson::Document parsed(const std::string& text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text);
  if (document.HasParseError()) throw std::runtime_error("not JSON: \"" + text + "\"");
  return document;
}

TEST(TrkDump, PrintsBinaryDatagramsOfExistingProgramsBitForBit) {
  Program dump({TRK_TOOL, "dump", "udp://127.0.0.1:0?layout=identified", "--json"});
  const std::uint16_t port = port_of(dump);
  const test::PlainSocket tracker;
  for (const auto& line : test::read_jsonl("field/identified_lp64/params.jsonl")) {
    tracker.send(test::from_hex(line["binary_hex"].GetString()), "127.0.0.1", port);
    const auto text = dump.out_line();
    ASSERT_TRUE(text);
    const auto json = parsed(*text);
    EXPECT_STREQ(json["type"].GetString(), "params");
    EXPECT_EQ(json["sender"].GetString(), "127.0.0.1:" + std::to_string(tracker.port()));
    auto expected = test::params_of(line["fields"]);
    EXPECT_EQ(params_of_json(json), expected);
  }
  dump.signal(SIGTERM);
  EXPECT_EQ(dump.rest_of_out(), "");
  EXPECT_THAT(dump.rest_of_err(), HasSubstr("malformed 0"));
  EXPECT_EQ(dump.wait(), 0);
}

TEST(TrkDump, EndsOnSigintWithASummary) {
  Program dump({TRK_TOOL, "dump", "udp://127.0.0.1:0"});
  const std::uint16_t port = port_of(dump);
  const test::PlainSocket tracker;
  for (const std::uint64_t counter : {1u, 2u, 5u}) {
    tracker.send(test::datagram(test::params(counter, 7)), "127.0.0.1", port);
    ASSERT_TRUE(dump.out_line()) << "each line is written at once, also into a pipe";
  }
  tracker.send("no record", "127.0.0.1", port);
  EXPECT_THAT(dump.err_line().value_or(""),
              HasSubstr("trk: malformed record from 127.0.0.1:" + std::to_string(tracker.port())));
  dump.signal(SIGINT);
  dump.rest_of_out();
  const std::string summary = dump.rest_of_err();
  EXPECT_THAT(summary, HasSubstr("received 3 (3 parameters, 0 constants), malformed 1"));
  EXPECT_THAT(summary, HasSubstr("id 7 from 127.0.0.1:" + std::to_string(tracker.port()) + ": 3 accepted, 2 lost"));
  EXPECT_EQ(dump.wait(), 0);
}

TEST(TrkDump, AReaderThatClosesThePipeEndsItWithoutError) {
  Program dump({TRK_TOOL, "dump", "file:" + test::data_path("field/takes/euler.trk") + "?speed=0&loop=1"});
  ASSERT_TRUE(dump.out_line());
  dump.close_out();
  EXPECT_THAT(dump.rest_of_err(), HasSubstr("trk: received "));
  EXPECT_EQ(dump.wait(), 0);
}

TEST(TrkDump, AFullDiskIsAFailure) {
  Program dump(
      {"/bin/sh", "-c",
       std::string(TRK_TOOL) + " dump 'file:" + test::data_path("field/takes/euler.trk") + "?speed=0' > /dev/full"});
  EXPECT_THAT(dump.rest_of_err(), HasSubstr("trk: error: standard output: No space left on device"));
  EXPECT_EQ(dump.wait(), 1);
}

TEST(TrkRelay, RecordsAnEqualTake) {
  const test::TemporaryDirectory directory;
  const std::string original = test::data_path("field/takes/euler.trk"), copy = directory / "copy.trk";
  Program relay({TRK_TOOL, "relay", "file:" + original + "?speed=0", "file:" + copy});
  EXPECT_THAT(relay.rest_of_err(), HasSubstr("sent to file " + copy + ": 2259 parameters, 1 constants, 0 errors"));
  EXPECT_EQ(relay.wait(), 0);
  const auto before = file::read_take(original), after = file::read_take(copy);
  EXPECT_EQ(after.params, before.params);
  EXPECT_EQ(after.constants, before.constants);
  EXPECT_EQ(after.time_code, before.time_code) << "which is the time of its first field";
}

/// A tracker on UDP, recorded.
class TrkRecording : public testing::Test {
 protected:
  void start(const std::vector<std::string>& sinks) {
    std::vector<std::string> words{TRK_TOOL, "relay", "udp://127.0.0.1:0"};
    words.insert(words.end(), sinks.begin(), sinks.end());
    relay.emplace(words);
    port = port_of(*relay);
    for (std::size_t i = 0; i < sinks.size(); ++i) ASSERT_TRUE(relay->err_line());
    tracker.send(test::datagram(test::constants()), "127.0.0.1", port);
  }
  void send_fields(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) tracker.send(test::datagram(test::params(++sent)), "127.0.0.1", port);
  }
  /// Waits until the file contains this many.
  testing::AssertionResult has_fields(const std::string& file, std::uint64_t count) const {
    const auto end = std::chrono::steady_clock::now() + test::deadline;
    while (std::chrono::steady_clock::now() < end) {
      try {
        if (file::read_take(file).params.size() >= count) return testing::AssertionSuccess();
      } catch (const transport::TransportError&) {
        // It has not started yet.
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return testing::AssertionFailure() << file << " has no " << count << " fields";
  }

  const test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
  const test::PlainSocket tracker;
  std::optional<Program> relay;
  std::uint16_t port = 0;
  std::uint64_t sent = 0;
};

TEST_F(TrkRecording, TwoSignalsInQuickSuccessionLoseNothing) {
  for (int round = 0; round < 12; ++round) {
    ASSERT_NO_FATAL_FAILURE(start({"file:" + path + "?overwrite=1"}));
    send_fields(20);
    ASSERT_TRUE(has_fields(path + ".part", 20));
    relay->signal(round % 2 == 0 ? SIGINT : SIGTERM);
    std::this_thread::sleep_for(std::chrono::microseconds(250 * (round / 4)));
    relay->signal(round % 3 == 0 ? SIGTERM : SIGINT);
    const std::string output = relay->rest_of_err();
    EXPECT_EQ(relay->wait(), 0) << output;
    EXPECT_EQ(file::read_take(path).params.size(), 20u);
    std::filesystem::remove(path);
  }
}

TEST_F(TrkRecording, RecordsWrittenBeforeAKillAreRecovered) {
  ASSERT_NO_FATAL_FAILURE(start({"file:" + path}));
  send_fields(100);
  ASSERT_TRUE(has_fields(path + ".part", 100));
  relay->signal(SIGKILL);
  EXPECT_EQ(relay->wait(), -SIGKILL);
  ASSERT_NO_FATAL_FAILURE(start({"file:" + path}));
  EXPECT_EQ(file::read_take(directory / "take.recovered.trk").params.size(), 100u);
  send_fields(1);
  ASSERT_TRUE(has_fields(path + ".part", 1));
  relay->signal(SIGINT);
  EXPECT_THAT(relay->rest_of_err(), HasSubstr("recovered from an interrupted recording: "));
  EXPECT_EQ(relay->wait(), 0);
}

TEST_F(TrkRecording, AFileThatCannotBeOpenedEndsItAtOnce) {
  test::write_text(path, "precious");
  const std::string other = directory / "other.trk";
  Program program({TRK_TOOL, "relay", "udp://127.0.0.1:0", "file:" + other, "file:" + path});
  EXPECT_THAT(program.rest_of_err(), HasSubstr("trk: error: " + path + ": cannot be written: it exists"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_FALSE(std::filesystem::exists(other + ".part"));
}

TEST_F(TrkRecording, ClosedStandardDescriptorsDoNotBecomeTheFile) {
  const std::string take = test::data_path("field/takes/euler.trk");
  const test::PlainSocket receiver;
  // The third descriptor that is opened.
  Program program({"/bin/sh", "-c",
                   "exec " + std::string(TRK_TOOL) + " relay 'file:" + take + "?speed=0' 'udp://127.0.0.1:" +
                       std::to_string(receiver.port()) + "' 'file:" + path + "' 0<&- 1>&- 2>&-"});
  program.rest_of_err();
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(file::read_take(path).params, file::read_take(take).params);
}

TEST_F(TrkRecording, AFifoWithoutReaderBlocksNobody) {
  const std::string fifo = directory / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const transport::Descriptor reader(::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  const test::PlainSocket receiver;
  ASSERT_NO_FATAL_FAILURE(
      start({"file:" + fifo, "udp://127.0.0.1:" + std::to_string(receiver.port()) + "?constants_period=0"}));
  // More than the pipe can hold.
  for (int i = 0; i < 2000; ++i) {
    send_fields(1);
    std::optional<std::string> datagram;
    do {
      datagram = receiver.receive();
      ASSERT_TRUE(datagram) << "set " << i;
    } while (datagram->at(6) != 'P');
  }
  const auto begin = std::chrono::steady_clock::now();
  relay->signal(SIGINT);
  const std::string output = relay->rest_of_err();
  EXPECT_EQ(relay->wait(), 1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_THAT(output, testing::ContainsRegex(
                          "error: file .*fifo: it does not respond and was abandoned; [0-9]+ queued records are lost"));
}

TEST(TrkRelay, ClosesAFileProperlyOnSigterm) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
  Program relay({TRK_TOOL, "relay", "udp://127.0.0.1:0", "file:" + path});
  const std::uint16_t port = port_of(relay);
  ASSERT_THAT(relay.err_line().value_or(""), HasSubstr(path));
  const test::PlainSocket tracker;
  tracker.send(test::datagram(test::constants()), "127.0.0.1", port);
  for (std::uint64_t counter = 1; counter <= 3; ++counter)
    tracker.send(test::datagram(test::params(counter)), "127.0.0.1", port);
  // A malformed record is reported after all records before it were written.
  tracker.send("no record", "127.0.0.1", port);
  ASSERT_THAT(relay.err_line().value_or(""), HasSubstr("malformed"));
  relay.signal(SIGTERM);
  const std::string summary = relay.rest_of_err();
  EXPECT_EQ(relay.wait(), 0) << summary;
  EXPECT_EQ(file::read_take(path).params.size(), 3u);
}

TEST(TrkRelay, WrongArgumentsEndItBeforeAnythingIsOpened) {
  const auto result = [](std::vector<std::string> words) {
    words.insert(words.begin(), TRK_TOOL);
    Program program(std::move(words));
    const std::string text = program.rest_of_err();
    return std::make_pair(program.wait(), text);
  };
  const test::TemporaryDirectory directory;
  const std::string from = "file:" + test::data_path("field/takes/euler.trk"), to = "file:" + (directory / "to.trk");
  auto [code, text] = result({"relay", from, to, "--format", "euler upside_down"});
  EXPECT_EQ(code, 2);
  EXPECT_THAT(text, testing::AllOf(HasSubstr("upside_down"), HasSubstr("studio_to_camera")));
  EXPECT_EQ(result({"relay", from}).first, 2);
  EXPECT_EQ(result({"relay", from, to, "--id", "-1"}).first, 2);
  EXPECT_EQ(result({"dump", "tcp://127.0.0.1:1"}).first, 2);
  EXPECT_EQ(result({"dump", from, "--count", "0"}).first, 2);
  EXPECT_EQ(result({}).first, 2);
  EXPECT_EQ(result({"--help"}).first, 0);
  std::tie(code, text) = result({"dump", "file:" + (directory / "absent.trk")});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(text, HasSubstr("trk: error: " + (directory / "absent.trk") + ": cannot be read: No such file"));
}

}  // namespace trk_bridge::tools::trk_program_test
