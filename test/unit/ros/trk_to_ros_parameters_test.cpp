// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/trk_to_ros_parameters.h"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "error_of.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1::trk_to_ros_parameters_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using XmlRpc::XmlRpcValue;

std::string message_of(const XmlRpcValue& tree, const std::string& camera_name = "crane1") {
  return test::error_of<ParameterError>([&] { read_trk_to_ros_parameters(tree, camera_name); });
}

/// One for every fault.
std::vector<std::string> lines_of(const XmlRpcValue& tree, const std::string& camera_name = "crane1") {
  std::istringstream text(message_of(tree, camera_name));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

XmlRpcValue tree_with_source() {
  XmlRpcValue tree;
  tree["source"] = "udp://:7000";
  return tree;
}

/// "left" and "right", on one port.
XmlRpcValue two_cameras() {
  auto tree = tree_with_source();
  tree["cameras"]["left"]["id"] = 1;
  tree["cameras"]["right"]["id"] = 2;
  return tree;
}

XmlRpcValue constants() {
  XmlRpcValue c;
  c["image_width"] = 1920;
  c["image_height"] = 1080;
  c["blank_left"] = 4;
  c["chip_width"] = 9.59;
  c["chip_height"] = 5;
  return c;
}

XmlRpcValue empty_map() {
  XmlRpcValue map;
  map.begin();
  return map;
}

struct Wrong {
  const char* name;
  void (*spoil)(XmlRpcValue&);
  const char* key_and_value;
  const char* allowed;
};

class ReadWrong : public ::testing::TestWithParam<Wrong> {};

TEST_P(ReadWrong, NamesKeyValueAndWhatIsAllowed) {
  auto tree = tree_with_source();
  GetParam().spoil(tree);
  EXPECT_THAT(lines_of(tree), ElementsAre(AllOf(HasSubstr(GetParam().key_and_value), HasSubstr(GetParam().allowed))));
}

const Wrong wrong_ones[] = {
    {"NoSource", [](XmlRpcValue& t) { t["source"] = ""; }, "~source = ''", "must be given"},
    {"NoPort", [](XmlRpcValue& t) { t["source"] = "udp://"; }, "~source = 'udp://'", "port"},
    {"Scheme", [](XmlRpcValue& t) { t["source"] = "tcp://:1"; }, "~source = 'tcp://:1'", "udp"},
    {"Rate", [](XmlRpcValue& t) { t["field_rate"] = 0; }, "~field_rate = 0", "must be 1 to 1000 Hz"},
    {"Stamp", [](XmlRpcValue& t) { t["stamp"] = "counted"; }, "~stamp = 'counted'", "arrival or counter or source"},
    {"RateNan", [](XmlRpcValue& t) { t["field_rate"] = std::nan(""); }, "~field_rate = nan", "1 to 1000 Hz"},
    {"Queue", [](XmlRpcValue& t) { t["queue_size"] = 0; }, "~queue_size = 0", "must be 1 to 100000"},
    {"Delay", [](XmlRpcValue& t) { t["delay"] = -0.5; }, "~delay = -0.5", "must be 0 to 60 seconds"},
    {"Distortion", [](XmlRpcValue& t) { t["distortion"] = "fisheye"; }, "~distortion = 'fisheye'",
     "must be auto or plumb_bob"},
    {"DelayTooLong", [](XmlRpcValue& t) { t["delay"] = 100; }, "~delay = 100", "must be 0 to 60 seconds"},
    {"Counter", [](XmlRpcValue& t) { t["counter"] = "loose"; }, "~counter = 'loose'", "auto or strict or ignore"},
    {"Failover", [](XmlRpcValue& t) { t["failover"] = -1; }, "~failover = -1", "must be 0 to 60 seconds"},
    {"Period", [](XmlRpcValue& t) { t["diagnostic_period"] = 0; }, "~diagnostic_period = 0", "more than 0 seconds"},
    {"Frame", [](XmlRpcValue& t) { t["studio_frame"] = "/studio"; }, "~studio_frame = '/studio'", "no leading slash"},
    {"EmptyFrame", [](XmlRpcValue& t) { t["camera_frame"] = ""; }, "~camera_frame = ''", "not empty"},
    {"SameFrame", [](XmlRpcValue& t) { t["camera_frame"] = "studio"; }, "~camera_frame = 'studio'", "must differ"},
    {"SameOptical", [](XmlRpcValue& t) { t["optical_frame"] = "crane1"; }, "~optical_frame = 'crane1'", "must differ"},
    {"Format", [](XmlRpcValue& t) { t["format"] = "eulr"; }, "~format = 'eulr'", "as_received"},
    {"Constants",
     [](XmlRpcValue& t) {
       t["constants"] = constants();
       t["constants"]["image_width"] = 0;
     },
     "~constants = [blank_left:4,", "image"},
    {"MarkersOfNoLens",
     [](XmlRpcValue& t) {
       t["publish_markers"] = true;
       t["publish_camera_info"] = false;
     },
     "~publish_markers = true", "needs publish_camera_info"},
    {"MarkerFarIsNear", [](XmlRpcValue& t) { t["marker_far"] = 0.2; }, "~marker_far = 0.2",
     "must be more than 0.2 and at most 1000 metres"},
    {"MarkerFarTooFar", [](XmlRpcValue& t) { t["marker_far"] = 1001; }, "~marker_far = 1001", "at most 1000 metres"},
    {"MarkerFarNan", [](XmlRpcValue& t) { t["marker_far"] = std::nan(""); }, "~marker_far = nan",
     "at most 1000 metres"},
    {"NoCameras", [](XmlRpcValue& t) { t["cameras"] = empty_map(); }, "~cameras = {}", "at least one"},
};
INSTANTIATE_TEST_SUITE_P(One, ReadWrong, ::testing::ValuesIn(wrong_ones),
                         [](const auto& test) { return test.param.name; });

TEST(Read, ACameraNameMustBeValidForTopicsAndFrames) {
  EXPECT_THAT(lines_of(tree_with_source(), "1st"),
              ElementsAre(AllOf(HasSubstr("camera name '1st'"), HasSubstr("begin with a letter"))));
  auto tree = two_cameras();
  tree["cameras"]["on the left"]["id"] = 3;
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("camera name 'on the left'")));
}

TEST(Read, CamerasOnOneSourceMustHaveDifferentIds) {
  auto tree = two_cameras();
  tree["cameras"]["right"]["id"] = 1;
  EXPECT_THAT(lines_of(tree), ElementsAre(AllOf(HasSubstr("~cameras/right/id = 1"), HasSubstr("left's"))));
  tree["cameras"]["right"] = empty_map();
  EXPECT_THAT(lines_of(tree),
              ElementsAre(AllOf(HasSubstr("~cameras/right/id = (none)"), HasSubstr("each must have an id"))));
  tree["cameras"]["left"] = empty_map();
  tree["cameras"]["right"]["id"] = 1;
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~cameras/left/id = (none)")));
  tree["cameras"]["right"]["source"] = "udp://:7001";
  EXPECT_EQ(message_of(tree), "no error") << "the only camera of a source needs none";
}

TEST(Read, OnePortHasOneUrl) {
  auto tree = two_cameras();
  tree["cameras"]["right"]["source"] = "udp://:7000?layout=identified";
  EXPECT_THAT(lines_of(tree),
              ElementsAre(AllOf(HasSubstr("~cameras/right/source"), HasSubstr("exactly the same URL"))));
}

TEST(Read, AFrameHasOneParent) {
  auto tree = two_cameras();
  tree["cameras"]["right"]["camera_frame"] = "left";
  EXPECT_THAT(lines_of(tree),
              ElementsAre(AllOf(HasSubstr("~cameras/right/camera_frame = 'left'"), HasSubstr("one parent"))));
}

TEST(Read, EveryKindOfFaultIsShownAtOnce) {
  auto tree = two_cameras();
  tree["field_rate"] = "fast";
  tree["delay"] = 100;
  tree["queuesize"] = 10;
  tree["constants"]["image_width"] = 1920.5;
  tree["cameras"]["left"]["publish_camera_info"] = false;
  tree["cameras"]["left"]["publish_markers"] = true;
  tree["cameras"]["right"]["id"] = 1;
  EXPECT_THAT(lines_of(tree),
              UnorderedElementsAre(HasSubstr("~field_rate = 'fast': must be a number"),
                                   HasSubstr("~delay = 100: must be 0 to 60 seconds"),
                                   HasSubstr("~queuesize = 10: unknown parameter, nearest is queue_size"),
                                   HasSubstr("~constants/image_width = 1920.5: must be an integer"),
                                   HasSubstr("~constants/image_height: must be given"),
                                   HasSubstr("~constants/chip_width: must be given"),
                                   HasSubstr("~constants/chip_height: must be given"),
                                   HasSubstr("~cameras/left/publish_markers = true: needs publish_camera_info"),
                                   HasSubstr("~cameras/right/id = 1: is camera left's, too")));
}

TEST(Read, ARuleIsNotCheckedOnFaultyInput) {
  auto tree = tree_with_source();
  tree["publish_markers"] = true;
  tree["publish_camera_info"] = "no";
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~publish_camera_info = 'no': must be true or false")));

  tree = tree_with_source();
  tree["studio_frame"] = 3;
  tree["camera_frame"] = "studio";
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~studio_frame = 3: must be text")))
      << "camera_frame is not compared with the default of the faulty studio_frame";

  tree = two_cameras();
  tree["cameras"]["left"]["id"] = -1;
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~cameras/left/id = -1: must be an integer, 0 to 4294967295")));

  tree = two_cameras();
  tree["cameras"]["right"]["source"] = "udp://";
  tree["cameras"]["right"]["id"] = 1;
  EXPECT_THAT(lines_of(tree), ElementsAre(HasSubstr("~cameras/right/source = 'udp://'")));
}

TEST(Read, FaultsOfAllCamerasAreShownOnce) {
  auto tree = two_cameras();
  tree["source"] = "udp://";
  tree["studio_frame"] = "/left";
  tree["cameras"]["left"]["publish_markers"] = true;
  tree["publish_camera_info"] = 0;
  EXPECT_THAT(lines_of(tree),
              UnorderedElementsAre(HasSubstr("~source = 'udp://'"), HasSubstr("~studio_frame = '/left'"),
                                   HasSubstr("~publish_camera_info = 0: must be true or false")));
}

TEST(Read, DefaultsNameTheCameraAndItsFrames) {
  const auto p = read_trk_to_ros_parameters(tree_with_source(), "crane1");
  ASSERT_EQ(p.cameras.size(), 1u);
  EXPECT_FALSE(p.several);
  EXPECT_FALSE(p.field_rate) << "it is found";
  EXPECT_EQ(p.queue_size, 100);
  const auto& c = p.cameras[0];
  EXPECT_EQ(c.name, "crane1");
  EXPECT_EQ(c.frames.studio, "studio");
  EXPECT_EQ(c.frames.camera, "crane1");
  EXPECT_EQ(c.frames.optical, "crane1_optical");
  EXPECT_EQ(c.source->url, "udp://:7000");
  EXPECT_EQ(c.source->place, "udp://:7000");
  EXPECT_EQ(c.options.format, std::uint32_t{wire::euler});
  EXPECT_FALSE(c.options.id || c.options.constants);
  EXPECT_EQ(c.options.delay, 0);
  EXPECT_TRUE(c.options.publish_tf && c.options.publish_camera_info);
  EXPECT_EQ(c.options.plumb_bob_tolerance, camera::plumb_bob_tolerance);
  EXPECT_FALSE(c.publish_markers);
  EXPECT_EQ(c.marker_far, 3);
}

TEST(Read, PlumbBobAlwaysIsATolerance) {
  auto tree = tree_with_source();
  tree["distortion"] = "plumb_bob";
  EXPECT_TRUE(std::isinf(read_trk_to_ros_parameters(tree, "crane1").cameras[0].options.plumb_bob_tolerance));
}

TEST(Read, StampsAreByCounterOverANetworkUnlessGiven) {
  using bridge::StampMode;
  const auto stamp_of = [](const char* source, const char* stamp) {
    auto tree = tree_with_source();
    tree["source"] = source;
    if (*stamp != 0) tree["stamp"] = stamp;
    return read_trk_to_ros_parameters(tree, "crane1").cameras[0].options.stamp;
  };
  EXPECT_EQ(stamp_of("udp://:7000", ""), StampMode::counter);
  EXPECT_EQ(stamp_of("shm:7", ""), StampMode::arrival);
  EXPECT_EQ(stamp_of("file:take.trk", ""), StampMode::arrival);
  EXPECT_EQ(stamp_of("udp://:7000", "arrival"), StampMode::arrival);
  EXPECT_EQ(stamp_of("shm:7", "counter"), StampMode::counter);
  EXPECT_EQ(stamp_of("udp://:7000", "source"), StampMode::source);

  auto tree = two_cameras();
  tree["stamp"] = "source";
  tree["cameras"]["left"]["stamp"] = "arrival";
  const auto p = read_trk_to_ros_parameters(tree, "crane1");
  EXPECT_EQ(p.cameras[0].options.stamp, StampMode::arrival);
  EXPECT_EQ(p.cameras[1].options.stamp, StampMode::source);
}

TEST(Read, CamerasInheritFromTheNodeAndMayDiffer) {
  auto tree = tree_with_source();
  tree["studio_frame"] = "stage";
  tree["delay"] = 1;  // an integer is a number, too
  tree["cameras"]["left"]["id"] = 1;
  tree["cameras"]["right"]["id"] = 2;
  tree["cameras"]["right"]["delay"] = 0.25;
  tree["cameras"]["top"]["source"] = "shm:7";
  tree["cameras"]["top"]["camera_frame"] = "jib";
  const auto p = read_trk_to_ros_parameters(tree, "ignored");
  ASSERT_EQ(p.cameras.size(), 3u);
  EXPECT_TRUE(p.several);
  EXPECT_EQ(p.cameras[0].name, "left");
  EXPECT_EQ(p.cameras[0].source->url, "udp://:7000");
  EXPECT_EQ(p.cameras[0].frames.studio, "stage");
  EXPECT_EQ(p.cameras[0].options.delay, 1.0);
  EXPECT_EQ(p.cameras[1].options.delay, 0.25);
  EXPECT_EQ(p.cameras[2].source->url, "shm:7");
  EXPECT_EQ(p.cameras[2].frames.camera, "jib");
  EXPECT_EQ(p.cameras[2].frames.optical, "top_optical");
  EXPECT_EQ(p.cameras[2].frames.studio, "stage");
}

TEST(Read, FormatsAreKeptAsMasks) {
  auto tree = tree_with_source();
  tree["format"] = "euler studio_y_up";
  EXPECT_EQ(read_trk_to_ros_parameters(tree, "c").cameras[0].options.format, wire::euler | wire::studio_y_up);
  tree["format"] = as_received;
  EXPECT_FALSE(read_trk_to_ros_parameters(tree, "c").cameras[0].options.format);
}

TEST(Read, MarkersOfAllCamerasExceptOne) {
  auto tree = tree_with_source();
  tree["publish_markers"] = true;
  tree["marker_far"] = 10;
  tree["cameras"]["left"]["id"] = 1;
  tree["cameras"]["right"]["id"] = 2;
  tree["cameras"]["right"]["publish_markers"] = false;
  const auto p = read_trk_to_ros_parameters(tree, "ignored");
  EXPECT_TRUE(p.cameras[0].publish_markers);
  EXPECT_EQ(p.cameras[0].marker_far, 10);
  EXPECT_FALSE(p.cameras[1].publish_markers);
}

TEST(Read, ConstantsByName) {
  auto tree = tree_with_source();
  tree["constants"] = constants();
  const auto p = read_trk_to_ros_parameters(tree, "crane1");
  ASSERT_TRUE(p.cameras[0].options.constants);
  EXPECT_EQ(*p.cameras[0].options.constants, (wire::CameraConstants{0, 1920, 1080, 4, 0, 0, 0, 9.59, 5, 0, 0}));
}

TEST(Read, ConstantsMustBeEnoughAndKnown) {
  auto tree = tree_with_source();
  tree["constants"]["image_width"] = 1920;
  tree["constants"]["image_hight"] = 1080;
  EXPECT_THAT(message_of(tree),
              AllOf(HasSubstr("~constants/image_height: must be given"),
                    HasSubstr("~constants/image_hight = 1080: unknown parameter, nearest is image_height")));
}

TEST(Read, RefusesUnknownKeysWithTheNearestKnown) {
  auto tree = tree_with_source();
  tree["fieldrate"] = 25;
  EXPECT_THAT(message_of(tree), HasSubstr("~fieldrate = 25: unknown parameter, nearest is field_rate; known are"));
}

TEST(Read, RefusesUnknownKeysOfACamera) {
  XmlRpcValue tree;
  tree["cameras"]["left"]["sorce"] = "shm:1";
  EXPECT_THAT(message_of(tree), HasSubstr("~cameras/left/sorce = 'shm:1': unknown parameter, nearest is source"));
}

TEST(Read, RefusesWrongTypesWithKeyValueAndAllowed) {
  auto tree = tree_with_source();
  tree["field_rate"] = "fast";
  tree["publish_tf"] = 1;
  tree["studio_frame"] = 3;
  tree["queue_size"] = 1.5;
  tree["constants"] = "none";
  EXPECT_THAT(
      message_of(tree),
      AllOf(HasSubstr("~field_rate = 'fast': must be a number"), HasSubstr("~publish_tf = 1: must be true or false"),
            HasSubstr("~studio_frame = 3: must be text"), HasSubstr("~queue_size = 1.5: must be an integer"),
            HasSubstr("~constants = 'none': must be a map")));
}

TEST(Read, RefusesNegativeIds) {
  auto tree = tree_with_source();
  tree["id"] = -1;
  EXPECT_THAT(message_of(tree), HasSubstr("~id = -1: must be an integer, 0 to 4294967295"));
}

TEST(Read, WithCamerasIdAndFramesBelongToEach) {
  auto tree = tree_with_source();
  tree["camera_frame"] = "cam";
  tree["cameras"]["left"]["id"] = 1;
  EXPECT_THAT(message_of(tree), HasSubstr("~camera_frame: belongs to each camera if cameras is set"));
}

TEST(Read, WithoutParametersTheSourceIsMissing) {
  EXPECT_THAT(message_of(XmlRpcValue()), HasSubstr("~source = '': must be given"));
}

TEST(Read, ATreeThatIsNotAMapIsRefused) { EXPECT_THAT(message_of(XmlRpcValue(7)), HasSubstr("must be a map")); }

}  // namespace trk_bridge::ros1::trk_to_ros_parameters_test
