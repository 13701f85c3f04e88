// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The parameters of test_card: defaults, and errors that name the key, the value and what is allowed.
#include "demo/test_card_parameters.h"

#include <gmock/gmock.h>

#include "ros/parameter_reader.h"

namespace trk_bridge::demo::test_card_parameters_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(const XmlRpc::XmlRpcValue& tree) {
  try {
    (void)read_test_card_parameters(tree, "crane");
  } catch (const ros1::ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(TestCardParameters, NoneAreNeeded) {
  const auto parameters = read_test_card_parameters({}, "crane");
  EXPECT_EQ(parameters.rate, 25);
  EXPECT_EQ(parameters.studio_frame, "studio");
  EXPECT_EQ(parameters.optical_frame, "crane_optical");
  EXPECT_EQ(parameters.place.y, 12);
}

TEST(TestCardParameters, AreRead) {
  XmlRpc::XmlRpcValue tree;
  tree["rate"] = 5;
  tree["studio_frame"] = "stage";
  tree["optical_frame"] = "camera_optical";
  tree["video_delay"] = 0.04;
  tree["x"] = -1.5;
  tree["y"] = 7;
  tree["width"] = 3;
  tree["depth"] = 2;
  tree["height"] = 2.5;
  tree["spacing"] = 0.5;
  const auto parameters = read_test_card_parameters(tree, "crane");
  EXPECT_EQ(parameters.rate, 5);
  EXPECT_EQ(parameters.studio_frame, "stage");
  EXPECT_EQ(parameters.optical_frame, "camera_optical");
  EXPECT_EQ(parameters.video_delay, 0.04);
  const Place& place = parameters.place;
  EXPECT_THAT((std::array{place.x, place.y, place.width, place.depth, place.height, place.spacing}),
              ::testing::ElementsAre(-1.5, 7, 3, 2, 2.5, 0.5));
}

TEST(TestCardParameters, EveryFaultIsReported) {
  XmlRpc::XmlRpcValue tree;
  tree["rate"] = 0;
  tree["spacing"] = 0.1;
  tree["width"] = 11;
  tree["hight"] = 3;
  tree["y"] = "far";
  EXPECT_THAT(refusal(tree), AllOf(HasSubstr("~rate = 0: must be 0.1 to 240 Hz"),
                                   HasSubstr("~width = 11: must not be more than 100 times spacing"),
                                   AllOf(HasSubstr("~hight"), HasSubstr("height")), HasSubstr("~y")));
}

TEST(TestCardParameters, TheSpacingIsAlwaysLargeEnough) {
  for (const double spacing : {0.0, -1.0, 0.001}) {
    XmlRpc::XmlRpcValue tree;
    tree["spacing"] = spacing;
    EXPECT_THAT(refusal(tree), HasSubstr("~spacing = "));
  }
}

TEST(TestCardParameters, SizesAreNotCheckedAgainstAWrongSpacing) {
  XmlRpc::XmlRpcValue tree;
  tree["spacing"] = "narrow";
  tree["width"] = 500;
  EXPECT_THAT(refusal(tree), AllOf(HasSubstr("~spacing = 'narrow': must be a number"), Not(HasSubstr("~width"))));
}

TEST(TestCardParameters, ARandomDelayExcludesAGivenOne) {
  XmlRpc::XmlRpcValue tree;
  tree["random_video_delay"] = true;
  EXPECT_TRUE(read_test_card_parameters(tree, "crane").random_video_delay);
  tree["video_delay"] = 0.02;
  EXPECT_THAT(refusal(tree), HasSubstr("~video_delay: must not be set together with random_video_delay"));
}

TEST(TestCardParameters, FramesMustBeValid) {
  XmlRpc::XmlRpcValue tree;
  tree["studio_frame"] = "/studio";
  tree["optical_frame"] = "";
  EXPECT_THAT(refusal(tree), AllOf(HasSubstr("~studio_frame = '/studio'"), HasSubstr("~optical_frame = ''")));
  tree["studio_frame"] = tree["optical_frame"] = "studio";
  EXPECT_THAT(refusal(tree), HasSubstr("must differ from studio_frame"));
}

}  // namespace trk_bridge::demo::test_card_parameters_test
