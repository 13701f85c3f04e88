// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/ros_to_trk_parameters.h"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "error_of.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1::ros_to_trk_parameters_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;
using XmlRpc::XmlRpcValue;

std::string message_of(const XmlRpcValue& tree) {
  return test::error_of<ParameterError>([&] { read_ros_to_trk_parameters(tree, "crane1"); });
}

/// One for every fault.
std::vector<std::string> lines_of(const XmlRpcValue& tree) {
  std::istringstream text(message_of(tree));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

XmlRpcValue tree_with_sink() {
  XmlRpcValue tree;
  tree["sinks"][0] = "udp://127.0.0.1:7000";
  return tree;
}

XmlRpcValue of_tf() {
  auto tree = tree_with_sink();
  tree["input"] = "tf";
  tree["chip_width"] = 9.59;
  tree["chip_height"] = 5.39;
  return tree;
}

auto has_url(const std::string& url) { return Field(&transport::SinkEndpoint::url, url); }

struct Wrong {
  const char* name;
  void (*spoil)(XmlRpcValue&);
  const char* key_and_value;
  const char* allowed;
};

class ReadOutgoingWrong : public ::testing::TestWithParam<Wrong> {};

TEST_P(ReadOutgoingWrong, NamesKeyValueAndWhatIsAllowed) {
  auto tree = of_tf();
  GetParam().spoil(tree);
  EXPECT_THAT(lines_of(tree), ElementsAre(AllOf(HasSubstr(GetParam().key_and_value), HasSubstr(GetParam().allowed))));
}

const Wrong wrong_ones[] = {
    {"NoSink", [](XmlRpcValue& t) { (t["sinks"] = XmlRpcValue()).setSize(0); }, "~sinks = []", "must be given"},
    {"SinkScheme", [](XmlRpcValue& t) { t["sinks"][0] = "tcp://x:1"; }, "~sinks = 'tcp://x:1'", "udp"},
    {"SinkOption", [](XmlRpcValue& t) { t["sinks"][0] = "udp://127.0.0.1:7000?allow=127.0.0.1"; }, "?allow=127.0.0.1'",
     "binary"},
    {"SinkTwice", [](XmlRpcValue& t) { t["sinks"][1] = "udp://127.0.0.1:7000"; }, "~sinks = 'udp", "twice"},
    {"Input", [](XmlRpcValue& t) { t["input"] = "topic"; }, "~input = 'topic'", "must be params or tf"},
    {"InputType", [](XmlRpcValue& t) { t["input"] = 1; }, "~input = 1", "must be params or tf"},
    {"Format", [](XmlRpcValue& t) { t["format"] = "eulr"; }, "~format = 'eulr'", "euler"},
    {"Preset", [](XmlRpcValue& t) { t["preset"] = "brainstrom"; }, "~preset = 'brainstrom'", "brainstorm"},
    {"Both",
     [](XmlRpcValue& t) {
       t["format"] = "euler";
       t["preset"] = "orad";
     },
     "~preset = 'orad'", "must not be set together with format"},
    {"Queue", [](XmlRpcValue& t) { t["queue_size"] = 0; }, "~queue_size = 0", "1 to 100000"},
    {"Constants",
     [](XmlRpcValue& t) {
       t["input"] = "params";
       for (const char* key : {"image_width", "image_height", "chip_width", "chip_height"}) t["constants"][key] = 0;
     },
     "~constants", "image"},
    {"Rate", [](XmlRpcValue& t) { t["rate"] = 0.5; }, "~rate = 0.5", "1 to 1000 Hz"},
    {"RateNan", [](XmlRpcValue& t) { t["rate"] = std::nan(""); }, "~rate = nan", "1 to 1000 Hz"},
    {"NoChip",
     [](XmlRpcValue& t) {
       t = tree_with_sink();
       t["input"] = "tf";
       t["chip_height"] = 5.39;
     },
     "~chip_width = (none)", "must be given"},
    {"Chip", [](XmlRpcValue& t) { t["chip_height"] = -1; }, "~chip_height = -1", "more than 0 mm"},
    {"Blank", [](XmlRpcValue& t) { t["blank_top"] = -1; }, "~blank_top = -1", "0 or more pixels"},
    {"Frame", [](XmlRpcValue& t) { t["camera_frame"] = "/crane1"; }, "~camera_frame = '/crane1'", "leading slash"},
    {"SameFrame", [](XmlRpcValue& t) { t["camera_frame"] = "studio"; }, "~camera_frame = 'studio'", "must differ"},
    {"Focus", [](XmlRpcValue& t) { t["focdist"] = -1; }, "~focdist = -1", "0 or more metres"},
    {"Aperture", [](XmlRpcValue& t) { t["aperture"] = std::nan(""); }, "~aperture = nan", "0 or more"},
};
INSTANTIATE_TEST_SUITE_P(One, ReadOutgoingWrong, ::testing::ValuesIn(wrong_ones),
                         [](const auto& test) { return test.param.name; });

TEST(ReadOutgoing, OnlyTfNeedsAChip) {
  XmlRpcValue tree;
  tree["sinks"][0] = "shm:7";
  tree["sinks"][1] = "file:take.trk?overwrite=1";
  EXPECT_EQ(message_of(tree), "no error");
}

TEST(ReadOutgoing, EveryKindOfFaultIsShownAtOnce) {
  auto tree = of_tf();
  tree["sinks"][1] = "udp://";
  tree["sinks"][2] = "shm:99";
  tree["rate"] = "fast";
  tree["focdist"] = -1;
  tree["apperture"] = 2;
  tree["camera_frame"] = "studio";
  EXPECT_THAT(lines_of(tree),
              UnorderedElementsAre(HasSubstr("~sinks = 'udp://'"), HasSubstr("~sinks = 'shm:99'"),
                                   HasSubstr("~rate = 'fast': must be 1 to 1000 Hz"), HasSubstr("~focdist = -1"),
                                   HasSubstr("~apperture = 2: unknown parameter, nearest is aperture"),
                                   HasSubstr("~camera_frame = 'studio': must differ")));
}

TEST(ReadOutgoing, ARuleIsNotCheckedOnFaultyInput) {
  auto tree = tree_with_sink();
  tree["input"] = "tff";
  tree["blank_left"] = 3;
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~input = 'tff'")))
      << "it is not known whether it needs a chip or may have blanks";

  tree = tree_with_sink();
  tree["format"] = 7;
  tree["preset"] = "orad";
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~format = 7: must be text")));

  tree = of_tf();
  tree["studio_frame"] = "/studio";
  tree["camera_frame"] = "studio";
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~studio_frame = '/studio'")));
}

TEST(ReadOutgoing, Defaults) {
  const auto p = read_ros_to_trk_parameters(tree_with_sink(), "crane1");
  EXPECT_EQ(p.name, "crane1");
  EXPECT_THAT(p.sinks, ElementsAre(has_url("udp://127.0.0.1:7000")));
  EXPECT_EQ(p.input, OutgoingInput::params);
  EXPECT_FALSE(p.rate || p.pace || p.form.is_timed()) << "params are sent at once";
  EXPECT_EQ(p.studio_frame, "studio");
  EXPECT_EQ(p.camera_frame, "crane1");
  EXPECT_FALSE(p.form.id || p.constants);
  EXPECT_TRUE(p.tf.frame_T_camera.matrix().isIdentity());
  EXPECT_EQ(p.form.format, std::uint32_t{wire::euler});
  EXPECT_TRUE(p.form.sends_id);
}

TEST(ReadOutgoing, OneSinkMayBeATextAndSeveralAreAList) {
  XmlRpcValue tree;
  tree["sinks"] = "shm:7";
  EXPECT_THAT(read_ros_to_trk_parameters(tree, "c").sinks, ElementsAre(has_url("shm:7")));
  tree["sinks"] = XmlRpcValue();
  tree["sinks"][0] = "shm:7";
  tree["sinks"][1] = "shm:8";
  EXPECT_THAT(read_ros_to_trk_parameters(tree, "c").sinks, ElementsAre(has_url("shm:7"), has_url("shm:8")));
  tree["sinks"][1] = 8;
  EXPECT_THAT(message_of(tree), AllOf(HasSubstr("~sinks"), HasSubstr("must be a list of texts")));
}

TEST(ReadOutgoing, EverythingOfTf) {
  auto tree = tree_with_sink();
  tree["input"] = "tf";
  tree["rate"] = 25;
  tree["chip_width"] = 9.59;
  tree["chip_height"] = 5;
  tree["blank_left"] = 3;
  tree["studio_frame"] = "stage";
  tree["camera_frame"] = "head_optical";
  tree["camera_frame_is_optical"] = true;
  tree["focdist"] = 4;
  tree["aperture"] = 2.8;
  tree["id"] = 7;
  tree["preset"] = "orad";
  const auto p = read_ros_to_trk_parameters(tree, "crane1");
  EXPECT_EQ(p.rate, 25);
  EXPECT_EQ(p.tf.chip.chip_height, 5.0);
  EXPECT_EQ(p.tf.chip.blank_left, 3);
  EXPECT_EQ(p.studio_frame, "stage");
  EXPECT_EQ(p.camera_frame, "head_optical");
  EXPECT_TRUE(p.tf.frame_T_camera.isApprox(camera_T_optical().inverse()));
  EXPECT_EQ(p.tf.focdist, 4);
  EXPECT_EQ(p.tf.aperture, 2.8);
  EXPECT_EQ(p.form.id, 7u);
  EXPECT_TRUE(wire::has(p.form.format.value(), wire::shift_in_pixels | wire::vertical | wire::camera_y_up));
}

TEST(ReadOutgoing, TfIsPacedAtARateOrSentOnArrival) {
  auto tree = of_tf();
  EXPECT_EQ(read_ros_to_trk_parameters(tree, "c").rate, 50);
  EXPECT_TRUE(read_ros_to_trk_parameters(tree, "c").pace);
  tree["rate"] = "tf";
  EXPECT_FALSE(read_ros_to_trk_parameters(tree, "c").rate);
  EXPECT_FALSE(read_ros_to_trk_parameters(tree, "c").pace);
  tree["pace"] = true;
  EXPECT_TRUE(read_ros_to_trk_parameters(tree, "c").pace);
  tree["rate"] = "fast";
  EXPECT_THAT(message_of(tree), HasSubstr("~rate = 'fast': must be 1 to 1000 Hz, or tf"));
  tree["rate"] = 0;
  EXPECT_THAT(message_of(tree), HasSubstr("~rate = 0: must be 1 to 1000 Hz"));
  auto params = tree_with_sink();
  params["rate"] = "tf";
  EXPECT_THAT(message_of(params), HasSubstr("~rate = 'tf': must be 1 to 1000 Hz"));
  params["rate"] = 59.94;
  params["pace"] = true;
  EXPECT_EQ(read_ros_to_trk_parameters(params, "c").rate, 59.94);
  EXPECT_TRUE(read_ros_to_trk_parameters(params, "c").pace);
}

TEST(ReadOutgoing, ADelayIsOneNumberOrOnePerPart) {
  using transport::Delay;
  auto tree = tree_with_sink();
  tree["delay"] = 0.04;
  tree["lead"] = 0.0125;
  EXPECT_EQ(read_ros_to_trk_parameters(tree, "c").form.delay, (Delay{40'000'000, 40'000'000, 40'000'000}));
  EXPECT_EQ(read_ros_to_trk_parameters(tree, "c").form.lead, 12'500'000);
  tree["delay"] = XmlRpcValue();
  tree["delay"]["position"] = 0.04;
  tree["delay"]["rotation"] = 0;
  EXPECT_THAT(message_of(tree), HasSubstr("~delay/lens = (none): must be given"));
  tree["delay"]["lens"] = 0.06;
  EXPECT_EQ(read_ros_to_trk_parameters(tree, "c").form.delay, (Delay{40'000'000, 0, 60'000'000}));
  tree["delay"]["zoom"] = 0.06;
  tree["delay"]["lens"] = 1.5;
  EXPECT_THAT(message_of(tree),
              AllOf(HasSubstr("~delay/zoom"), HasSubstr("~delay/lens = 1.5: must be 0 to 1 seconds")));
  tree["delay"] = -0.01;
  tree["lead"] = 0.05;
  EXPECT_THAT(message_of(tree), AllOf(HasSubstr("~delay = -0.01: must be 0 to 1 seconds"),
                                      HasSubstr("~lead = 0.05: must be 0 to 0.04 seconds")));
}

TEST(ReadOutgoing, ASinkMayHaveItsOwnForm) {
  XmlRpcValue tree;
  tree["sinks"][0] = "udp://127.0.0.1:7000?preset=unreal_trackmen";
  tree["sinks"][1] = "shm:7?id=3";
  tree["preset"] = "aximmetry";
  const auto p = read_ros_to_trk_parameters(tree, "c");
  const auto unreal = transport::with_defaults(p.sinks.at(0).form, p.form);
  EXPECT_EQ(unreal.format, std::uint32_t{wire::euler});
  EXPECT_FALSE(unreal.sends_id);
  const auto other = transport::with_defaults(p.sinks.at(1).form, p.form);
  EXPECT_EQ(other.format, p.form.format);
  EXPECT_EQ(other.id, 3u);
}

TEST(ReadOutgoing, TheReceiverWithoutIds) {
  auto tree = tree_with_sink();
  tree["preset"] = "unreal_trackmen";
  EXPECT_FALSE(read_ros_to_trk_parameters(tree, "c").form.sends_id);
}

TEST(ReadOutgoing, WhatBelongsToTheOtherInputIsRefused) {
  auto tree = tree_with_sink();
  tree["blank_left"] = 3;
  EXPECT_THAT(message_of(tree), HasSubstr("~blank_left: belongs to input tf"));
  tree = tree_with_sink();
  tree["input"] = "tf";
  tree["constants"]["image_width"] = 1920;
  EXPECT_THAT(message_of(tree), HasSubstr("~constants: belongs to input params"));
}

TEST(ReadOutgoing, ReportsEveryUnknownKeyAndWrongType) {
  auto tree = tree_with_sink();
  tree["sink"] = "shm:7";
  tree["id"] = -1;
  tree["rate"] = "fast";
  EXPECT_THAT(message_of(tree), AllOf(HasSubstr("~sink = 'shm:7': unknown parameter, nearest is sinks"),
                                      HasSubstr("~id = -1"), HasSubstr("~rate = 'fast': must be 1 to 1000 Hz")));
}

TEST(ReadOutgoing, APresetOfASchemeIsOnlyForItsSinks) {
  XmlRpcValue tree;
  tree["sinks"][0] = "freed://127.0.0.1:40000";
  EXPECT_THAT(message_of(tree), HasSubstr("option lens is missing")) << "the generic profile has counts";
  tree["preset"] = "freed_zcam";
  EXPECT_EQ(message_of(tree), "no error");
  tree["sinks"][1] = "udp://127.0.0.1:7000";
  EXPECT_THAT(message_of(tree), HasSubstr("the preset freed_zcam is for freed, and not for udp"));
  tree["sinks"][1] = "udp://127.0.0.1:7000?preset=disguise";
  EXPECT_EQ(message_of(tree), "no error") << "it has its own";
}

}  // namespace trk_bridge::ros1::ros_to_trk_parameters_test
