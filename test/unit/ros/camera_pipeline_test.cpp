#include "ros/camera_pipeline.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::ros1 {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t today = 1'700'000'000 * second;
constexpr std::int64_t field = 20'000'000;

const CameraFrames frames{"studio", "crane1", "crane1_optical"};

wire::CameraConstants constants(std::uint32_t id = 0) { return {id, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

/// Euler, told as an image distance: needs no constants.
wire::CameraParams params(std::uint64_t counter, std::uint32_t id = 0) {
  wire::CameraParams p;
  p.id = id;
  p.format = wire::euler;
  p.euler = {1, 2, 3, 30, -5, 0};
  p.fov = 10;
  p.counter = counter;
  return p;
}

transport::Sample sample(const wire::Record& record, std::int64_t arrival = today) {
  transport::Sample s;
  s.record = record;
  s.arrival = arrival;
  return s;
}

TEST(CameraPipeline, OneStampForEverythingOfASample) {
  CameraOptions options;
  options.delay = 0.04;
  CameraPipeline pipeline(options, frames, 50);
  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 5);
  ASSERT_TRUE(made.params && made.camera_info && made.transform);
  const ::ros::Time expected(1'699'999'999, 960'000'000);
  EXPECT_EQ(pipeline.params().header.stamp, expected);
  EXPECT_EQ(pipeline.camera_info().header.stamp, expected);
  EXPECT_EQ(pipeline.transform().header.stamp, expected);
  EXPECT_EQ(pipeline.params().header.frame_id, "studio");
  EXPECT_EQ(pipeline.camera_info().header.frame_id, "crane1_optical");
  EXPECT_EQ(pipeline.transform().header.frame_id, "studio");
  EXPECT_EQ(pipeline.transform().child_frame_id, "crane1");
  EXPECT_EQ(pipeline.statistics().last_news, 5);
}

TEST(CameraPipeline, DuplicatesAndLateOnesGiveNothingARestartDoes) {
  CameraPipeline pipeline({}, frames, 50);
  const auto published = [&pipeline](std::uint64_t counter, std::int64_t arrival) {
    const auto made = pipeline.process(sample(params(counter), arrival), 0);
    EXPECT_EQ(made.params, made.transform);
    return made.transform;
  };
  EXPECT_TRUE(published(1000, today));
  EXPECT_TRUE(published(1002, today + field));
  EXPECT_FALSE(published(1002, today + 2 * field)) << "duplicate";
  EXPECT_FALSE(published(1001, today + 3 * field)) << "late";
  const auto before = pipeline.transform().header.stamp;
  EXPECT_TRUE(published(1, today - 3600 * second)) << "restart, with a clock that stepped back";
  EXPECT_GT(pipeline.transform().header.stamp, before);
  const auto& counts = pipeline.statistics().sequence;
  EXPECT_EQ(counts.accepted, 3u);
  EXPECT_EQ(counts.duplicates, 1u);
  EXPECT_EQ(counts.late, 1u);
  EXPECT_EQ(counts.lost, 0u);
  EXPECT_EQ(counts.restarts, 1u);
  EXPECT_EQ(pipeline.statistics().held_stamps, 1u);
}

TEST(CameraPipeline, AMatrixThatIsNoRotationIsDropped) {
  CameraPipeline pipeline({}, frames, 50);
  auto p = params(1);
  p.format = 0;
  p.matrix = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_FALSE(made.params || made.transform || made.camera_info);
  EXPECT_EQ(pipeline.statistics().dropped, 1u);
  EXPECT_EQ(pipeline.statistics().drop_reason, camera::CameraReason::not_a_rotation);
}

TEST(CameraPipeline, WhatIsNotFiniteIsDropped) {
  CameraPipeline pipeline({}, frames, 50);
  std::uint64_t counter = 0;
  for (double wire::CameraParams::*field_of : {&wire::CameraParams::fov, &wire::CameraParams::k1,
                                               &wire::CameraParams::center_x, &wire::CameraParams::focdist}) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      auto p = params(++counter);
      p.*field_of = bad;
      const auto made = pipeline.process(sample(p), 0);
      EXPECT_FALSE(made.params || made.transform || made.camera_info);
    }
  }
  auto p = params(++counter);
  p.euler.pan = std::nan("");
  EXPECT_FALSE(pipeline.process(sample(p), 0).transform);
  EXPECT_EQ(pipeline.statistics().dropped, counter);
}

TEST(CameraPipeline, WithholdsParamsThatNeedUnknownConstantsWhileTheTransformGoesOn) {
  CameraPipeline pipeline({}, frames, 50);
  auto p = params(1);
  p.format |= wire::field_of_view;
  p.fov = 50;
  auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.transform);
  EXPECT_FALSE(made.params || made.camera_info);
  EXPECT_EQ(pipeline.statistics().withheld, 1u);
  EXPECT_EQ(pipeline.statistics().withhold_reason, camera::CameraReason::constants_needed);

  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  p.counter = 2;
  made = pipeline.process(sample(p), 0);
  ASSERT_TRUE(made.params && made.camera_info && made.transform);
  EXPECT_EQ(pipeline.params().format, wire::euler);
  EXPECT_NEAR(pipeline.params().fov, 9.59 / 2 / std::tan(25 * M_PI / 180), 1e-12);
  EXPECT_EQ(pipeline.params().counter, 2u);
}

TEST(CameraPipeline, AsReceivedLeavesTheRecordAlone) {
  CameraOptions configured;
  configured.format.reset();
  CameraPipeline pipeline(configured, frames, 50);
  auto p = params(1);
  p.format |= wire::field_of_view | wire::diagonal | wire::shift_in_pixels | 0x400;
  p.fov = 50;
  p.center_x = 3;
  ASSERT_TRUE(pipeline.process(sample(p), 0).params);
  EXPECT_EQ(pipeline.params().format, p.format);
  EXPECT_EQ(pipeline.params().fov, 50);
  EXPECT_EQ(pipeline.params().center_x, 3);
}

TEST(CameraPipeline, ReceivedConstantsWinOverTheParameterAndOwnOnesOverThoseOfAnyCamera) {
  CameraOptions configured;
  configured.id = 7;
  configured.constants = constants();
  configured.constants->image_width = 720;
  CameraPipeline pipeline(configured, frames, 50);
  ASSERT_TRUE(pipeline.has_constants());
  EXPECT_EQ(pipeline.constants().image_width, 720);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::parameter);

  EXPECT_TRUE(pipeline.process(sample(constants(0)), 0).constants);
  EXPECT_EQ(pipeline.constants().image_width, 1920);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::any_camera);

  auto own = constants(7);
  own.image_width = 1280;
  EXPECT_TRUE(pipeline.process(sample(own), 0).constants);
  EXPECT_FALSE(pipeline.process(sample(own), 0).constants) << "unchanged";
  EXPECT_FALSE(pipeline.process(sample(constants(0)), 0).constants) << "has its own";
  EXPECT_EQ(pipeline.constants().image_width, 1280);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::own);
}

TEST(CameraPipeline, ConstantsWithoutAPictureAreIgnored) {
  CameraPipeline pipeline({}, frames, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto bad = constants();
  bad.blank_left = 1920;
  EXPECT_FALSE(pipeline.process(sample(bad), 0).constants);
  EXPECT_EQ(pipeline.statistics().bad_constants, 1u);
  EXPECT_EQ(pipeline.constants().blank_left, 0);
}

TEST(CameraPipeline, WantsItsIdOrAnyWhereItHasNone) {
  CameraOptions configured;
  EXPECT_TRUE(CameraPipeline(configured, frames, 50).wants(params(1, 3)));
  configured.id = 7;
  const CameraPipeline pipeline(configured, frames, 50);
  EXPECT_TRUE(pipeline.wants(params(1, 7)));
  EXPECT_FALSE(pipeline.wants(params(1, 3)));
  EXPECT_FALSE(pipeline.wants(params(1, 0)));
  EXPECT_TRUE(pipeline.wants(constants(7)));
  EXPECT_TRUE(pipeline.wants(constants(0)));
  EXPECT_FALSE(pipeline.wants(constants(3)));
}

TEST(CameraPipeline, CountsIdsThatChange) {
  CameraPipeline pipeline({}, frames, 50);
  for (const std::uint32_t id : {3u, 3u, 4u, 3u}) (void)pipeline.process(sample(params(1, id)), 0);
  EXPECT_EQ(pipeline.statistics().id_changes, 2u);
}

TEST(CameraPipeline, NoCameraInfoForALensThatFoldsTheImage) {
  CameraPipeline pipeline({}, frames, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto p = params(1);
  p.k1 = -0.05;  // folds at r = sqrt(1 / 0.15) = 2.6 mm, the corner is at 5.5 mm
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.transform && made.params);
  EXPECT_FALSE(made.camera_info);
  EXPECT_EQ(pipeline.statistics().info_reason, camera::CameraReason::not_monotonic);
}

TEST(CameraPipeline, WhatIsSwitchedOffIsNotMade) {
  CameraOptions configured;
  configured.publish_tf = false;
  configured.publish_camera_info = false;
  CameraPipeline pipeline(configured, frames, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 0);
  EXPECT_TRUE(made.params);
  EXPECT_FALSE(made.transform || made.camera_info);
  EXPECT_EQ(pipeline.statistics().without_camera_info, 0u);
}

TEST(CameraPipeline, ATimeOutsideOfRosTimeIsDropped) {
  CameraPipeline pipeline({}, frames, 50);
  EXPECT_FALSE(pipeline.process(sample(params(1), -1), 0).transform);
  EXPECT_EQ(pipeline.statistics().unstampable, 1u);
  EXPECT_TRUE(pipeline.process(sample(params(2)), 0).transform);
}

}  // namespace
}  // namespace trk_bridge::ros1
