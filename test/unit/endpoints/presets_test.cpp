// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "endpoints/presets.h"

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/endpoints/endpoints.h"

namespace trk_bridge::endpoints::presets_test {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Presets, AreTheKnownReceiversWithTheirMasks) {
  const std::map<std::string, std::uint32_t> expected{
      {"pixotope", 0x001},       {"disguise", 0x001},    {"hippotizer", 0x001}, {"unreal_trackmen", 0x001},
      {"aximmetry", 0x09C},      {"brainstorm", 0x231},  {"deltatre", 0x031},   {"marketgraph", 0x09E},
      {"marketgraph_v2", 0x29E}, {"monarch", 0x0B9},     {"nsynk", 0x019},      {"orad", 0x2BC},
      {"rt_soft", 0x239},        {"nodos", 0x011},       {"freed", 0x001},      {"freed_sony", 0x001},
      {"freed_zcam", 0x001},     {"freed_vizrt", 0x001}, {"freed_mosys", 0x001}};
  std::map<std::string, std::uint32_t> found;
  for (const auto& preset : presets()) found[preset.name] = preset.format;
  EXPECT_EQ(found, expected);
  EXPECT_EQ(presets().size(), expected.size());
}

TEST(Presets, OnlyUnrealIsSentNoId) {
  for (const auto& preset : presets()) EXPECT_EQ(preset.sends_id, preset.name != "unreal_trackmen") << preset.name;
}

TEST(Presets, HaveQuirksOfOneLine) {
  for (const auto& preset : presets()) {
    EXPECT_GT(preset.quirks.size(), 20U) << preset.name;
    EXPECT_THAT(preset.quirks, Not(HasSubstr("\n"))) << preset.name;
  }
  EXPECT_THAT(find_preset("unreal_trackmen")->quirks, HasSubstr("Drops ASCII records with an id"));
}

TEST(Presets, AreThoseOfTheFileThatIsInstalled) {
  std::ifstream file(PRESETS_YAML);
  const std::string yaml{std::istreambuf_iterator<char>(file), {}};
  const auto read = presets_from_yaml(yaml, "presets.yaml");
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), presets().size());
  for (std::size_t i = 0; i < read->size(); ++i) {
    EXPECT_EQ((*read)[i].name, presets()[i].name);
    EXPECT_EQ((*read)[i].format, presets()[i].format);
    EXPECT_EQ((*read)[i].sends_id, presets()[i].sends_id);
    EXPECT_EQ((*read)[i].quirks, presets()[i].quirks);
  }
}

TEST(Presets, OfAnotherSchemeSetItsOptions) {
  for (const auto& preset : presets()) {
    EXPECT_EQ(preset.scheme, preset.name.rfind("freed", 0) == 0 ? "freed" : "") << preset.name;
    if (preset.scheme.empty()) continue;
    const std::string url = preset.scheme + "://127.0.0.1:1?lens=none";
    EXPECT_TRUE(parse_sink(url + "&preset=" + preset.name)) << preset.name;
    EXPECT_TRUE(parse_sink(url, preset.name)) << preset.name;
  }
  // Only zcam needs no lens table.
  EXPECT_TRUE(parse_sink("freed://127.0.0.1:1?preset=freed_zcam"));
  EXPECT_TRUE(parse_sink("freed://127.0.0.1:1", "freed_zcam"));
  EXPECT_FALSE(parse_sink("freed://127.0.0.1:1?preset=freed_vizrt", "freed_zcam")) << "the preset of the URL is used";
  EXPECT_FALSE(parse_sink("freed://127.0.0.1:1?preset=freed_zcam&profile=sony")) << "the URL's option is used";
  EXPECT_TRUE(parse_sink("udp://127.0.0.1:1?preset=disguise", "freed_zcam"));
  for (const auto& refused :
       {parse_sink("udp://127.0.0.1:1?preset=freed_zcam"), parse_sink("udp://127.0.0.1:1", "freed_zcam")}) {
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error(), HasSubstr("the preset freed_zcam is for freed, and not for udp"));
  }
}

TEST(FindPreset, UnknownNamesAreRefusedWithTheNearest) {
  const auto preset = find_preset("pixotop");
  ASSERT_FALSE(preset);
  EXPECT_THAT(preset.error(),
              StartsWith("no such preset 'pixotop', nearest is pixotope; known are pixotope, disguise"));
  EXPECT_THAT(find_preset("unreal").error(), HasSubstr("'unreal'"));
  EXPECT_THAT(find_preset("marketgraphv2").error(), HasSubstr("nearest is marketgraph_v2"));
  EXPECT_THAT(find_preset("").error(), HasSubstr("no such preset ''"));
}

std::string error_of(const std::string& yaml) {
  const auto read = presets_from_yaml(yaml, "p.yaml");
  return read ? "no error" : read.error();
}

TEST(PresetsFromYaml, ReadsValidEntries) {
  const auto read =
      presets_from_yaml("a_1:\n  quirks: >-\n    one\n    two\n  sends_id: false\n  format: Euler VERTICAL\n", "");
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), 1U);
  EXPECT_EQ(read->front().name, "a_1");
  EXPECT_EQ(read->front().format, 0x021U);
  EXPECT_FALSE(read->front().sends_id);
  EXPECT_EQ(read->front().quirks, "one two");
}

TEST(PresetsFromYaml, ErrorsNameTheLine) {
  const std::string good = "a:\n  format: euler\n  sends_id: true\n  quirks: none\n";
  EXPECT_EQ(error_of(good), "no error");
  EXPECT_THAT(error_of(good + "b:\n  format: euler\n  send_id: true\n  quirks: none\n"),
              StartsWith("p.yaml:7: preset b: no such key 'send_id', nearest is sends_id"));
  EXPECT_THAT(error_of(good + "b:\n  format: euler oiler\n  sends_id: true\n  quirks: none\n"),
              StartsWith("p.yaml:6: preset b: format: 'oiler' is not a format word; allowed are matrix euler"));
  EXPECT_THAT(error_of(good + "b:\n  format: [euler]\n  sends_id: true\n  quirks: none\n"),
              StartsWith("p.yaml:6: preset b: format: must be text"));
  EXPECT_THAT(error_of(good + "b:\n  format: euler\n  sends_id: perhaps\n  quirks: none\n"),
              StartsWith("p.yaml:7: preset b: sends_id: must be true or false"));
  EXPECT_THAT(error_of(good + "b:\n  format: euler\n  sends_id: true\n  quirks:\n"),
              StartsWith("p.yaml:8: preset b: quirks: must be text"));
  EXPECT_THAT(error_of(good + "b:\n  format: euler\n  sends_id: true\n"),
              StartsWith("p.yaml:6: preset b: quirks is missing"));
  EXPECT_THAT(error_of(good + "b:\n  format: euler\n  format: matrix\n  sends_id: true\n  quirks: none\n"),
              StartsWith("p.yaml:7: preset b: format is given twice"));
  EXPECT_THAT(error_of(good + good), StartsWith("p.yaml:5: preset a is given twice"));
  EXPECT_THAT(error_of(good + "B c:\n  format: euler\n"), StartsWith("p.yaml:5: name of a preset 'B c': must be"));
  EXPECT_THAT(error_of(good + "b: euler\n"), StartsWith("p.yaml:5: preset b: must be a map"));
  EXPECT_THAT(error_of(good + "b: {format: euler\n"), StartsWith("p.yaml:"));
}

TEST(PresetsFromYaml, SchemeAndOptions) {
  const std::string one = "a:\n  format: euler\n  sends_id: true\n  quirks: none\n";
  const auto read = presets_from_yaml(one + "  scheme: freed\n  options: profile=sony&unwrap=0\n", "p.yaml");
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->front().scheme, "freed");
  ASSERT_EQ(read->front().options.size(), 2U);
  EXPECT_EQ(read->front().options[1].key, "unwrap");
  EXPECT_EQ(read->front().options[1].value, "0");
  EXPECT_THAT(error_of(one + "  options: profile=sony\n"), StartsWith("p.yaml:5: preset a: options: need a scheme"));
  EXPECT_THAT(error_of(one + "  scheme: freed\n  options: sony\n"), StartsWith("p.yaml:6: preset a: options: option"));
}

TEST(PresetsFromYaml, EntriesThatAreNotMapsAreRefused) {
  EXPECT_THAT(error_of("- a\n- b\n"), StartsWith("p.yaml:1: must be a map of presets"));
  EXPECT_THAT(error_of("just text"), StartsWith("p.yaml:1: must be a map of presets"));
  EXPECT_THAT(error_of(""), HasSubstr("must be a map of presets"));
}

}  // namespace trk_bridge::endpoints::presets_test
