// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// `trk presets` and `trk relay --preset`, run like a user does.
#include <csignal>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include "program.h"
#include "trk_bridge/wire/codec.h"
#include "udp.h"

namespace trk_bridge::tools::preset_program_test {

using test::Program;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TrkPresets, ListsNameWordsAndQuirks) {
  Program presets({TRK_TOOL, "presets"});
  const std::string list = presets.rest_of_out();
  EXPECT_THAT(list, HasSubstr("aximmetry\n"
                              "  sends   matrix camera_to_studio camera_y_up studio_y_up field_of_view horizontal "
                              "ignore_blank adjust_aspect shift_on_chip\n"
                              "  quirks  Matrix, camera and studio both y-up."));
  EXPECT_THAT(list, HasSubstr("shift_on_chip; never an id\n  quirks  Drops ASCII records with an id"));
  EXPECT_THAT(presets.rest_of_err(), IsEmpty());
  EXPECT_EQ(presets.wait(), 0);
}

TEST(TrkPresets, AreJsonForPrograms) {
  Program presets({TRK_TOOL, "presets", "--json"});
  std::map<std::string, unsigned> masks;
  while (const auto line = presets.out_line()) {
    rapidjson::Document one;
    ASSERT_FALSE(one.Parse(line->c_str()).HasParseError()) << *line;
    masks[one["name"].GetString()] = one["format"].GetUint();
    EXPECT_EQ(one["sends_id"].GetBool(), masks.count("unreal_trackmen") == 0 || one["name"] != "unreal_trackmen");
    EXPECT_NE(one["quirks"].GetStringLength(), 0U);
    EXPECT_NE(one["format_words"].GetStringLength(), 0U);
  }
  EXPECT_EQ(masks.size(), 19U);
  EXPECT_EQ(masks["orad"], 0x2BCU);
  presets.rest_of_err();
  EXPECT_EQ(presets.wait(), 0);
}

/// What a receiver on the loopback receives for constants and parameters of camera 3.
struct Received {
  wire::CameraConstants constants;
  wire::CameraParams params;
};
Received relayed_to(const std::string& preset) {
  const test::PlainSocket receiver;
  Program relay({TRK_TOOL, "relay", "udp://127.0.0.1:0", "udp://127.0.0.1:" + std::to_string(receiver.port()),
                 "--preset", preset});
  const std::uint16_t port = port_of(relay);
  const test::PlainSocket tracker;
  tracker.send(test::datagram(test::constants(720, 3)), "127.0.0.1", port);
  tracker.send(test::datagram(test::params(77, 3)), "127.0.0.1", port);
  Received received;
  wire::LayoutDetector detector;
  for (int i = 0; i < 2; ++i) {
    const auto record = wire::decode(receiver.receive().value_or(""), detector);
    if (!record) throw std::runtime_error("no record was received: " + wire::describe(record.error()));
    if (const auto* params = std::get_if<wire::CameraParams>(&record->record)) received.params = *params;
    if (const auto* constants = std::get_if<wire::CameraConstants>(&record->record)) received.constants = *constants;
  }
  relay.signal(SIGTERM);
  relay.rest_of_out();
  relay.rest_of_err();
  EXPECT_EQ(relay.wait(), 0);
  return received;
}

TEST(TrkRelay, SendsAReceiverTheFormatOfItsPreset) {
  const Received received = relayed_to("orad");
  EXPECT_EQ(received.params.format, 0x2BCU);
  EXPECT_EQ(received.params.id, 3U);
  EXPECT_EQ(received.params.counter, 77U);
  EXPECT_EQ(received.constants.id, 3U);
  // A camera at z = 1.75 m in a z-up studio is at y = 1.75 m in a y-up one, where y forward is -z.
  EXPECT_DOUBLE_EQ(received.params.matrix[12], 1.5);
  EXPECT_DOUBLE_EQ(received.params.matrix[13], 1.75);
  EXPECT_DOUBLE_EQ(received.params.matrix[14], 2);
  // 2 atan(6.6 / (2 * 42)) in degrees: the complete chip, because there are no blanks.
  EXPECT_NEAR(received.params.fov, 8.985163, 1e-6);
}

TEST(TrkRelay, APresetWithoutIdSendsNone) {
  const Received received = relayed_to("unreal_trackmen");
  EXPECT_EQ(received.params.format, 0x001U);
  EXPECT_EQ(received.params.id, 0U);
  EXPECT_EQ(received.constants.id, 0U);
}

std::string refusal(const std::vector<std::string>& options) {
  std::vector<std::string> words{TRK_TOOL, "relay", "udp://127.0.0.1:0", "udp://127.0.0.1:9"};
  words.insert(words.end(), options.begin(), options.end());
  Program relay(words);
  const std::string text = relay.rest_of_err();
  EXPECT_THAT(relay.rest_of_out(), IsEmpty());
  EXPECT_EQ(relay.wait(), 2);
  return text;
}

TEST(TrkRelay, UnknownPresetsAreRefusedWithTheNearest) {
  EXPECT_THAT(refusal({"--preset", "pixotop"}),
              HasSubstr("trk: error: --preset: no such preset 'pixotop', nearest is pixotope; known are pixotope"));
}

TEST(TrkRelay, APresetAndFormatWordsExcludeEachOther) {
  EXPECT_THAT(refusal({"--preset", "orad", "--format", "euler"}), HasSubstr(" excludes --"));
}

TEST(TrkRelay, AnIdForAReceiverWithoutIdsIsRefused) {
  EXPECT_THAT(refusal({"--preset", "unreal_trackmen", "--id", "3"}),
              HasSubstr("--id 3: the preset unreal_trackmen sends no id; only 0 is allowed"));
  EXPECT_THAT(
      refusal({"udp://127.0.0.1:10?id=3", "--preset", "unreal_trackmen"}),
      HasSubstr("endpoint \"udp://127.0.0.1:10?id=3\": id 3 with a preset that sends no id; only 0 is allowed"));
}

}  // namespace trk_bridge::tools::preset_program_test
