#include "ros/ros_to_trk_parameters.h"

#include <cmath>

#include <gmock/gmock.h>

#include "ros/parameter_reader.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using XmlRpc::XmlRpcValue;

RosToTrkParameters of_params() {
  RosToTrkParameters p;
  p.name = p.camera_frame = "crane1";
  p.sinks = {"udp://127.0.0.1:7000"};
  return p;
}

RosToTrkParameters of_tf() {
  auto p = of_params();
  p.input = "tf";
  p.chip_width = 9.59;
  p.chip_height = 5.39;
  return p;
}

std::string message_of(const XmlRpcValue& tree) {
  try {
    read_ros_to_trk_parameters(tree, "crane1");
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

XmlRpcValue tree_with_sink() {
  XmlRpcValue tree;
  tree["sinks"][0] = "udp://127.0.0.1:7000";
  return tree;
}

TEST(ValidateOutgoing, AcceptsBothInputs) {
  EXPECT_THAT(validate(of_params()), IsEmpty());
  EXPECT_THAT(validate(of_tf()), IsEmpty());
}

struct Wrong {
  const char* name;
  void (*spoil)(RosToTrkParameters&);
  const char* key_and_value;
  const char* allowed;
};

class ValidateOutgoingWrong : public ::testing::TestWithParam<Wrong> {};

TEST_P(ValidateOutgoingWrong, NamesKeyValueAndWhatIsAllowed) {
  auto p = of_tf();
  GetParam().spoil(p);
  EXPECT_THAT(validate(p), ElementsAre(AllOf(HasSubstr(GetParam().key_and_value), HasSubstr(GetParam().allowed))));
}

const Wrong wrong_ones[] = {
    {"NoSink", [](RosToTrkParameters& p) { p.sinks.clear(); }, "~sinks = []", "must be given"},
    {"SinkScheme", [](RosToTrkParameters& p) { p.sinks[0] = "tcp://x:1"; }, "~sinks = 'tcp://x:1'", "udp"},
    {"SinkOption", [](RosToTrkParameters& p) { p.sinks[0] += "?allow=127.0.0.1"; }, "?allow=127.0.0.1'", "binary"},
    {"SinkTwice", [](RosToTrkParameters& p) { p.sinks.push_back(p.sinks[0]); }, "~sinks = 'udp", "twice"},
    {"Input", [](RosToTrkParameters& p) { p.input = "topic"; }, "~input = 'topic'", "params or tf"},
    {"Format", [](RosToTrkParameters& p) { p.format = "eulr"; }, "~format = 'eulr'", "euler"},
    {"Preset", [](RosToTrkParameters& p) { p.preset = "brainstrom"; }, "~preset = 'brainstrom'", "brainstorm"},
    {"Both",
     [](RosToTrkParameters& p) {
       p.format = "euler";
       p.preset = "orad";
     },
     "~preset = 'orad'", "must not be given with format"},
    {"Queue", [](RosToTrkParameters& p) { p.queue_size = 0; }, "~queue_size = 0", "1 to 100000"},
    {"Constants", [](RosToTrkParameters& p) { p.constants = wire::CameraConstants{}; }, "~constants", "image"},
    {"Rate", [](RosToTrkParameters& p) { p.rate = 0.5; }, "~rate = 0.5", "1 to 1000 Hz"},
    {"RateNan", [](RosToTrkParameters& p) { p.rate = std::nan(""); }, "~rate = nan", "1 to 1000 Hz"},
    {"NoChip", [](RosToTrkParameters& p) { p.chip_width.reset(); }, "~chip_width = (none)", "must be given"},
    {"Chip", [](RosToTrkParameters& p) { p.chip_height = -1; }, "~chip_height = -1", "more than 0 mm"},
    {"Blank", [](RosToTrkParameters& p) { p.blank_top = -1; }, "~blank_top = -1", "0 or more"},
    {"Frame", [](RosToTrkParameters& p) { p.camera_frame = "/crane1"; }, "~camera_frame = '/crane1'", "leading slash"},
    {"SameFrame", [](RosToTrkParameters& p) { p.camera_frame = "studio"; }, "~camera_frame = 'studio'", "must differ"},
    {"Focus", [](RosToTrkParameters& p) { p.focdist = -1; }, "~focdist = -1", "0 or more"},
    {"Aperture", [](RosToTrkParameters& p) { p.aperture = std::nan(""); }, "~aperture = nan", "0 or more"},
};
INSTANTIATE_TEST_SUITE_P(One, ValidateOutgoingWrong, ::testing::ValuesIn(wrong_ones),
                         [](const auto& test) { return test.param.name; });

TEST(ValidateOutgoing, OnlyTfNeedsAChip) {
  auto p = of_params();
  EXPECT_FALSE(p.chip_width);
  p.sinks = {"shm:7", "file:take.trk?overwrite=1"};
  EXPECT_THAT(validate(p), IsEmpty());
}

TEST(ReadOutgoing, Defaults) {
  const auto p = read_ros_to_trk_parameters(tree_with_sink(), "crane1");
  EXPECT_EQ(p.name, "crane1");
  EXPECT_THAT(p.sinks, ElementsAre("udp://127.0.0.1:7000"));
  EXPECT_EQ(p.input, "params");
  EXPECT_EQ(p.rate, 50);
  EXPECT_EQ(p.studio_frame, "studio");
  EXPECT_EQ(p.camera_frame, "crane1");
  EXPECT_FALSE(p.camera_frame_is_optical || p.id || p.constants);
  const auto form = form_of(p);
  EXPECT_EQ(form.format, std::uint32_t{wire::euler});
  EXPECT_TRUE(form.sends_id);
}

TEST(ReadOutgoing, OneSinkMayBeATextAndSeveralAreAList) {
  XmlRpcValue tree;
  tree["sinks"] = "shm:7";
  EXPECT_THAT(read_ros_to_trk_parameters(tree, "c").sinks, ElementsAre("shm:7"));
  tree["sinks"] = XmlRpcValue();
  tree["sinks"][0] = "shm:7";
  tree["sinks"][1] = "shm:8";
  EXPECT_THAT(read_ros_to_trk_parameters(tree, "c").sinks, ElementsAre("shm:7", "shm:8"));
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
  EXPECT_EQ(p.chip_height, 5.0);
  EXPECT_EQ(p.blank_left, 3);
  EXPECT_EQ(p.studio_frame, "stage");
  EXPECT_EQ(p.camera_frame, "head_optical");
  EXPECT_TRUE(p.camera_frame_is_optical);
  EXPECT_EQ(p.focdist, 4);
  EXPECT_EQ(p.aperture, 2.8);
  EXPECT_EQ(p.id, 7u);
  EXPECT_TRUE(wire::has(form_of(p).format, wire::shift_in_pixels | wire::vertical | wire::camera_y_up));
}

TEST(ReadOutgoing, TheReceiverThatTakesNoId) {
  auto tree = tree_with_sink();
  tree["preset"] = "unreal_trackmen";
  EXPECT_FALSE(form_of(read_ros_to_trk_parameters(tree, "c")).sends_id);
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

TEST(ReadOutgoing, TellsEveryUnknownKeyAndWrongType) {
  auto tree = tree_with_sink();
  tree["sink"] = "shm:7";
  tree["id"] = -1;
  tree["rate"] = "fast";
  EXPECT_THAT(message_of(tree), AllOf(HasSubstr("~sink = 'shm:7': no such parameter, nearest is sinks"),
                                      HasSubstr("~id = -1"), HasSubstr("~rate = 'fast': must be a number")));
}

}  // namespace
}  // namespace trk_bridge::ros1
