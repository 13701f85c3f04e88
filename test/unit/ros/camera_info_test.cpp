// Which lens of a CameraInfo is drawn.
#include "trk_bridge/ros/camera_info.h"

#include <gmock/gmock.h>

namespace trk_bridge::ros1 {
namespace {

sensor_msgs::CameraInfo info_of(const std::string& model, std::vector<double> d) {
  sensor_msgs::CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.K = {1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1};
  info.distortion_model = model;
  info.D = std::move(d);
  return info;
}

void expect_fault(const sensor_msgs::CameraInfo& info, InfoReason reason) {
  const auto lens = viewing_lens(info);
  ASSERT_FALSE(lens);
  EXPECT_EQ(lens.error().reason, reason) << describe(lens.error());
}

TEST(ViewingLens, IsWhatTheMessageSays) {
  const auto lens = viewing_lens(info_of("plumb_bob", {-0.1, 0.01, 1e-3, 2e-3, 0.5}));
  ASSERT_TRUE(lens);
  const camera::ViewingLens expected{
      {1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1}, {-0.1, 0.01, 1e-3, 2e-3, 0.5}, 1920, 1080};
  EXPECT_EQ(*lens, expected);
}

TEST(ViewingLens, IsThatOfTheWholeImageWhateverPartOfItIsSent) {
  auto info = info_of("", {});
  info.binning_x = info.binning_y = 2;
  info.roi.x_offset = 100;
  info.roi.width = info.roi.height = 50;
  const auto lens = viewing_lens(info);
  ASSERT_TRUE(lens);
  EXPECT_EQ(*lens, *viewing_lens(info_of("", {})));
}

TEST(ViewingLens, IsNoneWithoutPixelsOrOfOtherModels) {
  auto info = info_of("", {});
  info.height = 0;
  expect_fault(info, InfoReason::no_size);
  // Four coefficients, but of a fisheye.
  expect_fault(info_of("equidistant", {0.1, 0, 0, 0}), InfoReason::unknown_model);
  expect_fault(info_of("", {0.1, 0, 0, 0}), InfoReason::unknown_model);
  expect_fault(info_of("plumb_bob", {0.1, 0, 0, 0, 0, 0, 0, 0}), InfoReason::coefficients);
  expect_fault(info_of("rational_polynomial", {0.1, 0, 0, 0, 0}), InfoReason::coefficients);
}

}  // namespace
}  // namespace trk_bridge::ros1
