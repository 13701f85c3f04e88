#include "ros/trk_to_ros_parameters.h"

#include <cmath>

#include <gmock/gmock.h>

#include "ros/parameter_reader.h"

namespace trk_bridge::ros1 {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using XmlRpc::XmlRpcValue;

CameraParameters camera(const std::string& name, const std::string& source) {
  CameraParameters c;
  c.name = name;
  c.source = source;
  c.camera_frame = name;
  c.optical_frame = name + "_optical";
  return c;
}

TrkToRosParameters one_camera() {
  TrkToRosParameters p;
  p.cameras = {camera("crane1", "udp://:7000")};
  return p;
}

TrkToRosParameters two_cameras() {
  TrkToRosParameters p;
  p.several = true;
  p.cameras = {camera("left", "udp://:7000"), camera("right", "udp://:7000")};
  p.cameras[0].id = 1;
  p.cameras[1].id = 2;
  return p;
}

std::string message_of(const XmlRpcValue& tree) {
  try {
    read_trk_to_ros_parameters(tree, "crane1");
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

XmlRpcValue tree_with_source() {
  XmlRpcValue tree;
  tree["source"] = "udp://:7000";
  return tree;
}

TEST(Validate, AcceptsTheDefaults) {
  EXPECT_THAT(validate(one_camera()), IsEmpty());
  EXPECT_THAT(validate(two_cameras()), IsEmpty());
}

struct Wrong {
  const char* name;
  void (*spoil)(TrkToRosParameters&);
  const char* key_and_value;
  const char* allowed;
};

class ValidateWrong : public ::testing::TestWithParam<Wrong> {};

TEST_P(ValidateWrong, NamesKeyValueAndWhatIsAllowed) {
  auto p = one_camera();
  GetParam().spoil(p);
  EXPECT_THAT(validate(p), ElementsAre(AllOf(HasSubstr(GetParam().key_and_value), HasSubstr(GetParam().allowed))));
}

const Wrong wrong_ones[] = {
    {"NoSource", [](TrkToRosParameters& p) { p.cameras[0].source = ""; }, "~source = ''", "must be given"},
    {"NoPort", [](TrkToRosParameters& p) { p.cameras[0].source = "udp://"; }, "~source = 'udp://'", "port"},
    {"Scheme", [](TrkToRosParameters& p) { p.cameras[0].source = "tcp://:1"; }, "~source = 'tcp://:1'", "udp"},
    {"Rate", [](TrkToRosParameters& p) { p.field_rate = 0; }, "~field_rate = 0", "1 to 1000 Hz"},
    {"RateNan", [](TrkToRosParameters& p) { p.field_rate = std::nan(""); }, "~field_rate = nan", "1 to 1000 Hz"},
    {"Stamp", [](TrkToRosParameters& p) { p.stamp = "now"; }, "~stamp = 'now'", "arrival"},
    {"Counter", [](TrkToRosParameters& p) { p.stamp = "counter"; }, "~stamp = 'counter'",
     "not available in this version"},
    {"Queue", [](TrkToRosParameters& p) { p.queue_size = 0; }, "~queue_size = 0", "1 to 100000"},
    {"Delay", [](TrkToRosParameters& p) { p.cameras[0].delay = -0.5; }, "~delay = -0.5", "0 to 60 seconds"},
    {"Frame", [](TrkToRosParameters& p) { p.cameras[0].studio_frame = "/studio"; }, "~studio_frame = '/studio'",
     "no leading slash"},
    {"EmptyFrame", [](TrkToRosParameters& p) { p.cameras[0].camera_frame = ""; }, "~camera_frame = ''", "not empty"},
    {"SameFrame", [](TrkToRosParameters& p) { p.cameras[0].camera_frame = "studio"; }, "~camera_frame = 'studio'",
     "must differ"},
    {"Name", [](TrkToRosParameters& p) { p.cameras[0].name = "1st"; }, "~name = '1st'", "begin with a letter"},
    {"Format", [](TrkToRosParameters& p) { p.cameras[0].format = "eulr"; }, "~format = 'eulr'", "as_received"},
    {"Constants", [](TrkToRosParameters& p) { p.cameras[0].constants = wire::CameraConstants{}; }, "~constants",
     "image"},
    {"MarkersOfNoLens",
     [](TrkToRosParameters& p) {
       p.cameras[0].publish_markers = true;
       p.cameras[0].publish_camera_info = false;
     },
     "~publish_markers = true", "needs publish_camera_info"},
    {"MarkerFarIsNear", [](TrkToRosParameters& p) { p.cameras[0].marker_far = 0.2; }, "~marker_far = 0.2",
     "more than 0.2 (where the frustum begins) and at most 1000 metres"},
    {"MarkerFarTooFar", [](TrkToRosParameters& p) { p.cameras[0].marker_far = 1001; }, "~marker_far = 1001",
     "at most 1000 metres"},
    {"MarkerFarNan", [](TrkToRosParameters& p) { p.cameras[0].marker_far = std::nan(""); }, "~marker_far = nan",
     "at most 1000 metres"},
    {"NoCameras", [](TrkToRosParameters& p) { p.cameras.clear(); }, "~cameras = {}", "at least one"},
};
INSTANTIATE_TEST_SUITE_P(One, ValidateWrong, ::testing::ValuesIn(wrong_ones),
                         [](const auto& test) { return test.param.name; });

TEST(Validate, CamerasOnOneSourceMustSayDifferentIds) {
  auto p = two_cameras();
  p.cameras[1].id = 1;
  EXPECT_THAT(validate(p), ElementsAre(AllOf(HasSubstr("~cameras/right/id = 1"), HasSubstr("left's"))));
  p.cameras[1].id.reset();
  EXPECT_THAT(validate(p), ElementsAre(AllOf(HasSubstr("each must say its id"), HasSubstr("camera right does not"))));
  p.cameras[1].source = "udp://:7001";
  EXPECT_THAT(validate(p), IsEmpty()) << "alone on its source it needs none";
}

TEST(Validate, OnePortHasOneUrl) {
  auto p = two_cameras();
  p.cameras[1].source = "udp://:7000?layout=identified";
  EXPECT_THAT(validate(p), ElementsAre(AllOf(HasSubstr("~cameras/right/source"), HasSubstr("very same URL"))));
}

TEST(Validate, AFrameHasOneParent) {
  auto p = two_cameras();
  p.cameras[1].camera_frame = "left";
  EXPECT_THAT(validate(p),
              ElementsAre(AllOf(HasSubstr("~cameras/right/camera_frame = 'left'"), HasSubstr("one parent"))));
}

TEST(Validate, TellsEveryFaultAtOnce) {
  auto p = one_camera();
  p.field_rate = -1;
  p.queue_size = -1;
  p.cameras[0].delay = 100;
  EXPECT_EQ(validate(p).size(), 3u);
}

TEST(Read, DefaultsNameTheCameraAndItsFrames) {
  const auto p = read_trk_to_ros_parameters(tree_with_source(), "crane1");
  ASSERT_EQ(p.cameras.size(), 1u);
  EXPECT_FALSE(p.several);
  EXPECT_EQ(p.field_rate, 50);
  EXPECT_EQ(p.queue_size, 100);
  const auto& c = p.cameras[0];
  EXPECT_EQ(c.name, "crane1");
  EXPECT_EQ(c.studio_frame, "studio");
  EXPECT_EQ(c.camera_frame, "crane1");
  EXPECT_EQ(c.optical_frame, "crane1_optical");
  EXPECT_EQ(c.format, "euler");
  EXPECT_FALSE(c.id);
  EXPECT_TRUE(c.publish_tf && c.publish_camera_info);
  EXPECT_FALSE(c.publish_markers);
  EXPECT_EQ(c.marker_far, 3);
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
  EXPECT_EQ(p.cameras[0].source, "udp://:7000");
  EXPECT_EQ(p.cameras[0].studio_frame, "stage");
  EXPECT_EQ(p.cameras[0].delay, 1.0);
  EXPECT_EQ(p.cameras[1].delay, 0.25);
  EXPECT_EQ(p.cameras[2].source, "shm:7");
  EXPECT_EQ(p.cameras[2].camera_frame, "jib");
  EXPECT_EQ(p.cameras[2].optical_frame, "top_optical");
  EXPECT_EQ(p.cameras[2].studio_frame, "stage");
}

TEST(Read, MarkersOfAllCamerasButOne) {
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
  auto& c = tree["constants"];
  c["image_width"] = 1920;
  c["image_height"] = 1080;
  c["blank_left"] = 4;
  c["chip_width"] = 9.59;
  c["chip_height"] = 5;
  const auto p = read_trk_to_ros_parameters(tree, "crane1");
  ASSERT_TRUE(p.cameras[0].constants);
  EXPECT_EQ(*p.cameras[0].constants, (wire::CameraConstants{0, 1920, 1080, 4, 0, 0, 0, 9.59, 5, 0, 0}));
}

TEST(Read, ConstantsMustBeEnoughAndKnown) {
  auto tree = tree_with_source();
  tree["constants"]["image_width"] = 1920;
  tree["constants"]["image_hight"] = 1080;
  EXPECT_THAT(message_of(tree),
              AllOf(HasSubstr("~constants/image_height: must be given"),
                    HasSubstr("~constants/image_hight = 1080: no such parameter, nearest is image_height")));
}

TEST(Read, RefusesUnknownKeysWithTheNearestKnown) {
  auto tree = tree_with_source();
  tree["fieldrate"] = 25;
  EXPECT_THAT(message_of(tree), HasSubstr("~fieldrate = 25: no such parameter, nearest is field_rate; known are"));
}

TEST(Read, RefusesUnknownKeysOfACamera) {
  XmlRpcValue tree;
  tree["cameras"]["left"]["sorce"] = "shm:1";
  EXPECT_THAT(message_of(tree), HasSubstr("~cameras/left/sorce = 'shm:1': no such parameter, nearest is source"));
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
  EXPECT_THAT(message_of(tree), HasSubstr("~id = -1: must be 0 or more"));
}

TEST(Read, WithCamerasIdAndFramesBelongToEach) {
  auto tree = tree_with_source();
  tree["camera_frame"] = "cam";
  tree["cameras"]["left"]["id"] = 1;
  EXPECT_THAT(message_of(tree), HasSubstr("~camera_frame: with cameras, it belongs to each of them"));
}

TEST(Read, NoParametersAtAllMissTheSource) {
  EXPECT_THAT(message_of(XmlRpcValue()), HasSubstr("~source = '': must be given"));
}

TEST(Read, ATreeThatIsNoMapIsRefused) { EXPECT_THAT(message_of(XmlRpcValue(7)), HasSubstr("must be a map")); }

}  // namespace
}  // namespace trk_bridge::ros1
