// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Free-D with the trk program, run like a user does.
#include <csignal>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "freed_messages.h"
#include "program.h"
#include "temporary_directory.h"
#include "udp.h"
#include "whole_take.h"

namespace trk_bridge::tools::freed_program_test {

using test::Program;
using testing::AllOf;
using testing::HasSubstr;

const std::string example = LENS_EXAMPLE;

/// The message with counts, of camera 7.
std::string message(std::uint32_t zoom, std::uint32_t focus) {
  freed::Message message;
  message.camera = 7;
  message.pan = 30 * 32768;
  message.zoom = zoom;
  message.focus = focus;
  const auto all = freed::bytes_of(message);
  return {all.data(), all.size()};
}

TEST(FreeDProgram, AStreamWithALensBecomesATake) {
  const test::TemporaryDirectory directory;
  const std::string take = directory / "freed.trk";
  const test::PlainSocket tracker, watcher;
  Program relay({TRK_TOOL, "relay", "freed://127.0.0.1:0?lens=" + example, "file:" + take,
                 "udp://127.0.0.1:" + std::to_string(watcher.port())});
  const std::uint16_t port = port_of(relay);
  for (int i = 0; i < 5; ++i) tracker.send(message(0, 65535), "127.0.0.1", port);
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(watcher.receive()) << "constants and five sets";
  relay.signal(SIGTERM);
  EXPECT_THAT(relay.rest_of_err(), HasSubstr("5 parameters"));
  EXPECT_EQ(relay.wait(), 0);
  const auto read = file::read_take(take);
  EXPECT_EQ(read.constants.id, 7u);
  EXPECT_EQ(read.constants.image_width, 1920);
  ASSERT_EQ(read.params.size(), 5u);
  for (std::uint64_t i = 0; i < 5; ++i) {
    EXPECT_EQ(read.params[i].counter, i);
    EXPECT_EQ(read.params[i].euler.pan, -30);
    EXPECT_NEAR(read.params[i].fov, 7.6, 1e-9);
    EXPECT_NEAR(read.params[i].focdist, 50, 1e-9);
  }
}

TEST(FreeDProgram, AStreamWithoutALensIsRefusedWithTheReason) {
  const test::TemporaryDirectory directory;
  Program relay({TRK_TOOL, "relay", "freed://127.0.0.1:0", "file:" + std::string(directory / "freed.trk")});
  const std::uint16_t port = port_of(relay);
  relay.err_line();
  const test::PlainSocket tracker;
  tracker.send(message(5, 6), "127.0.0.1", port);
  EXPECT_THAT(relay.err_line().value_or(""), AllOf(HasSubstr("cannot be passed on"), HasSubstr("have no lens")));
  relay.signal(SIGTERM);
  relay.rest_of_err();
  EXPECT_EQ(relay.wait(), 1);
}

TEST(FreeDProgram, DumpShowsCountsAndDoubts) {
  Program dump({TRK_TOOL, "dump", "freed://127.0.0.1:0?checksum=lenient", "--json"});
  const std::uint16_t port = port_of(dump);
  const test::PlainSocket tracker;
  auto datagram = message(5, 6);
  datagram.back() = 0;
  tracker.send(datagram, "127.0.0.1", port);
  const auto line = dump.out_line().value_or("");
  EXPECT_THAT(line,
              AllOf(HasSubstr("\"zoom_encoder\":5,\"focus_encoder\":6"), HasSubstr("\"doubt\":\"wrong checksum\"")));
  EXPECT_THAT(line, testing::Not(HasSubstr("fov"))) << "there is no lens";
  dump.signal(SIGTERM);
  dump.rest_of_out();
  EXPECT_THAT(dump.rest_of_err(), HasSubstr("1 records were accepted despite: wrong checksum"));
  EXPECT_EQ(dump.wait(), 0);
}

TEST(FreeDProgram, TrkBecomesFreeD) {
  const test::PlainSocket receiver;
  Program relay({TRK_TOOL, "relay", "udp://127.0.0.1:0", "freed://127.0.0.1:" + std::to_string(receiver.port()),
                 "--preset", "freed_zcam"});
  const std::uint16_t port = port_of(relay);
  const test::PlainSocket tracker;
  tracker.send(test::datagram(test::params(1, 9)), "127.0.0.1", port);
  const auto datagram = receiver.receive();
  ASSERT_TRUE(datagram);
  const auto read = freed::read(*datagram);
  ASSERT_TRUE(read && read->checksum_fits);
  EXPECT_EQ(read->message.camera, 9);
  EXPECT_EQ(read->message.pan, -30 * 32768);
  EXPECT_EQ(read->message.zoom, 4200u) << "zcam: 42 mm";
  EXPECT_EQ(read->message.focus, 45000u) << "4.5 m";
  relay.signal(SIGTERM);
  relay.rest_of_err();
  EXPECT_EQ(relay.wait(), 0);
}

TEST(TrkLens, ChecksAndPlots) {
  const test::TemporaryDirectory directory;
  const std::string plot = directory / "lens.svg";
  Program lens({TRK_TOOL, "lens", example, "--plot", plot});
  EXPECT_THAT(lens.rest_of_out(), HasSubstr("focal length: 7.6 to 140.904 mm\n"));
  lens.rest_of_err();
  EXPECT_EQ(lens.wait(), 0);
  std::ifstream file(plot);
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(file), {}), HasSubstr("</svg>"));

  const std::string bad = directory / "bad.yaml";
  std::ofstream(bad) << "points:\n- {zoom: 0, focal_length: 8}\n- {zoom: 1}\n";
  Program refused({TRK_TOOL, "lens", bad});
  EXPECT_THAT(refused.rest_of_err(), HasSubstr("trk: error: " + bad + ":3: either focal_length"));
  EXPECT_EQ(refused.wait(), 1);
}

}  // namespace trk_bridge::tools::freed_program_test
