// The launch files, started by the test's own one with a take that plays for ever.
#include <trk_bridge/CameraParams.h>
#include <visualization_msgs/MarkerArray.h>

#include "fixture.h"

namespace trk_bridge::test {
namespace {

class Launched : public ::testing::TestWithParam<const char*> {};

TEST_P(Launched, PublishesInTheNamespaceOfItsCamera) {
  const std::string camera = GetParam();
  Recorder<trk_bridge::CameraParams> params("/" + camera + "/params");
  TransformRecorder transforms("/tf", camera);
  TransformRecorder statics("/tf_static", camera + "_optical");
  ASSERT_TRUE(eventually(
      [&] { return params.messages.size() > 2 && transforms.transforms.size() > 2 && !statics.transforms.empty(); }));
  EXPECT_EQ(params.messages.front().header.frame_id, "stage");
  EXPECT_EQ(transforms.transforms.front().header.frame_id, "stage");
  EXPECT_EQ(statics.transforms.front().header.frame_id, camera);
  for (std::size_t i = 1; i < transforms.transforms.size(); ++i) {
    EXPECT_GT(transforms.transforms[i].header.stamp, transforms.transforms[i - 1].header.stamp);
  }
}

TEST(LaunchedMarkers, AreDrawnWhereTheyWereAskedFor) {
  Recorder<visualization_msgs::MarkerArray> markers("/launched_nodelet/trk_to_ros/markers");
  ASSERT_TRUE(eventually([&] { return !markers.messages.empty(); }));
  const auto& axis = markers.messages.front().markers.at(1);
  EXPECT_EQ(axis.ns, "launched_nodelet/axis");
  EXPECT_EQ(axis.points.back().z, 5);
  EXPECT_FALSE(is_advertised("/launched_node/trk_to_ros/markers"));
}

INSTANTIATE_TEST_SUITE_P(As, Launched, ::testing::Values("launched_node", "launched_nodelet"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace trk_bridge::test
