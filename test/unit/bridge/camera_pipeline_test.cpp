// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/camera_pipeline.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "pipeline_samples.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge::camera_pipeline_test {

TEST(CameraPipeline, OneStampForEverythingOfASample) {
  CameraOptions options;
  options.delay = 0.04;
  CameraPipeline pipeline(options, 50);
  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 5);
  ASSERT_TRUE(made.params && made.calibration && made.pose);
  EXPECT_EQ(made.stamp, today - 40'000'000);
  EXPECT_EQ(pipeline.statistics().last_new, 5);
}

TEST(CameraPipeline, DuplicatesAndLateRecordsAreNotPublishedRestartsAre) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  const auto published = [&pipeline](std::uint64_t counter, std::int64_t arrival) {
    const auto made = pipeline.process(sample(params(counter), arrival), 0);
    EXPECT_EQ(made.params.has_value(), made.pose.has_value());
    return made.stamp;
  };
  EXPECT_TRUE(published(1000, today));
  const auto before = published(1002, today + field);
  EXPECT_TRUE(before);
  EXPECT_FALSE(published(1002, today + 2 * field)) << "duplicate";
  EXPECT_FALSE(published(1001, today + 3 * field)) << "late";
  EXPECT_GT(published(1, today), before) << "restart, with a clock that stepped back a little";
  const auto& counts = pipeline.statistics().sequence;
  EXPECT_EQ(counts.accepted, 3u);
  EXPECT_EQ(counts.duplicates, 1u);
  EXPECT_EQ(counts.late, 1u);
  EXPECT_EQ(counts.lost, 0u);
  EXPECT_EQ(counts.restarts, 1u);
  EXPECT_EQ(pipeline.statistics().held_stamps, 1u);
}

TEST(CameraPipeline, AMatrixThatIsNotARotationIsDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.format = 0;
  p.matrix = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_FALSE(made.params || made.pose || made.calibration);
  EXPECT_EQ(pipeline.statistics().dropped, 1u);
  EXPECT_EQ(pipeline.statistics().drop_reason, camera::CameraReason::not_a_rotation);
}

TEST(CameraPipeline, ValuesThatAreNotFiniteAreDropped) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  std::uint64_t counter = 0;
  for (double wire::CameraParams::*field_of : {&wire::CameraParams::fov, &wire::CameraParams::k1,
                                               &wire::CameraParams::center_x, &wire::CameraParams::focdist}) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      auto p = params(++counter);
      p.*field_of = bad;
      const auto made = pipeline.process(sample(p), 0);
      EXPECT_FALSE(made.params || made.pose || made.calibration);
    }
  }
  auto p = params(++counter);
  p.euler.pan = std::nan("");
  EXPECT_FALSE(pipeline.process(sample(p), 0).pose);
  EXPECT_EQ(pipeline.statistics().dropped, counter);
}

TEST(CameraPipeline, WithholdsParamsThatNeedUnknownConstantsButPublishesTheTransform) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.format |= wire::field_of_view;
  p.fov = 50;
  auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.pose);
  EXPECT_FALSE(made.params || made.calibration);
  EXPECT_EQ(pipeline.statistics().withheld, 1u);
  EXPECT_EQ(pipeline.statistics().withhold_reason, camera::CameraReason::constants_needed);

  EXPECT_TRUE(pipeline.process(sample(constants()), 0).constants);
  p.counter = 2;
  made = pipeline.process(sample(p), 0);
  ASSERT_TRUE(made.params && made.calibration && made.pose);
  EXPECT_EQ(made.params->format, wire::euler);
  EXPECT_NEAR(made.params->fov, 9.59 / 2 / std::tan(25 * M_PI / 180), 1e-12);
  EXPECT_EQ(made.params->counter, 2u);
}

TEST(CameraPipeline, AsReceivedDoesNotChangeTheRecord) {
  CameraOptions configured;
  configured.format.reset();
  CameraPipeline pipeline(configured, 50);
  auto p = params(1);
  p.format |= wire::field_of_view | wire::diagonal | wire::shift_in_pixels | 0x400;
  p.fov = 50;
  p.center_x = 3;
  const auto made = pipeline.process(sample(p), 0);
  ASSERT_TRUE(made.params);
  EXPECT_EQ(made.params->format, p.format);
  EXPECT_EQ(made.params->fov, 50);
  EXPECT_EQ(made.params->center_x, 3);
}

TEST(CameraPipeline, ReceivedConstantsReplaceTheParameterAndOwnOnesThoseOfAnyCamera) {
  CameraOptions configured;
  configured.id = 7;
  configured.constants = constants();
  configured.constants->image_width = 720;
  CameraPipeline pipeline(configured, 50);
  ASSERT_TRUE(pipeline.initial().constants);
  EXPECT_EQ(pipeline.initial().constants->image_width, 720);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::parameter);

  auto made = pipeline.process(sample(constants(0)), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->image_width, 1920);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::any_camera);

  auto own = constants(7);
  own.image_width = 1280;
  made = pipeline.process(sample(own), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->image_width, 1280);
  EXPECT_FALSE(pipeline.process(sample(own), 0).constants) << "unchanged";
  EXPECT_FALSE(pipeline.process(sample(constants(0)), 0).constants) << "has its own";
  EXPECT_EQ(pipeline.process(sample(params(1, 7)), 0).calibration.value().width, 1280u);
  EXPECT_EQ(pipeline.statistics().constants, ConstantsOrigin::own);
}

TEST(CameraPipeline, ALaterCalibrationBelongsToItsSample) {
  auto wider = constants();
  wider.image_width = 3840;
  auto longer = params(2);
  longer.fov = 20;
  CameraPipeline at_once({}, 50.0), later({}, 50.0);
  for (auto* pipeline : {&at_once, &later}) static_cast<void>(pipeline->process(sample(constants()), 0));
  auto first = later.begin(sample(params(1)), 1);
  static_cast<void>(later.begin(sample(wider), 2));
  auto second = later.begin(sample(longer), 3);
  EXPECT_TRUE(first.params && first.pose && !first.calibration);
  EXPECT_EQ(later.statistics().without_camera_info, 0u);
  later.calibrate(first);
  later.calibrate(second);
  EXPECT_TRUE(later.statistics().has_camera_info);

  const auto first_at_once = at_once.process(sample(params(1)), 1);
  static_cast<void>(at_once.process(sample(wider), 2));
  const auto second_at_once = at_once.process(sample(longer), 3);
  ASSERT_TRUE(first.calibration && second.calibration);
  EXPECT_EQ(first.calibration->width, 1920u);
  EXPECT_EQ(second.calibration->width, 3840u);
  EXPECT_EQ(first.calibration->k, first_at_once.calibration->k);
  EXPECT_EQ(second.calibration->k, second_at_once.calibration->k);
  // Once and for all.
  const auto counted = later.statistics().without_camera_info;
  later.calibrate(second);
  EXPECT_EQ(later.statistics().without_camera_info, counted);
}

TEST(CameraPipeline, WithoutConstantsThereAreNoInitialOnes) {
  EXPECT_FALSE(CameraPipeline(CameraOptions{}, 50).initial().constants);
}

TEST(CameraPipeline, ConstantsAreStampedWithArrivalMinusDelayInThePublishedFormat) {
  CameraOptions configured;
  configured.delay = 0.04;
  configured.format = wire::euler | wire::field_of_view | wire::keep_aspect;
  CameraPipeline pipeline(configured, 50);
  auto received = constants();
  received.fake_chip_width = 0;
  auto made = pipeline.process(sample(received), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.stamp, today - 40'000'000);
  EXPECT_EQ(*made.constants, camera::constants_for(received, *configured.format));
  EXPECT_NE(*made.constants, received);

  received.image_width = 1280;
  made = pipeline.process(sample(received, -1), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.stamp, 0) << "no time is known";
}

TEST(CameraPipeline, InvalidConstantsAreIgnored) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto bad = constants();
  bad.blank_left = 1920;
  EXPECT_FALSE(pipeline.process(sample(bad), 0).constants);
  EXPECT_EQ(pipeline.statistics().bad_constants, 1u);
  EXPECT_TRUE(pipeline.process(sample(params(1)), 0).calibration) << "those before stay";
}

TEST(CameraPipeline, WantsItsIdOrAnyIfItHasNone) {
  CameraOptions configured;
  EXPECT_TRUE(CameraPipeline(configured, 50).wants(params(1, 3)));
  configured.id = 7;
  const CameraPipeline pipeline(configured, 50);
  EXPECT_TRUE(pipeline.wants(params(1, 7)));
  EXPECT_FALSE(pipeline.wants(params(1, 3)));
  EXPECT_FALSE(pipeline.wants(params(1, 0)));
  EXPECT_TRUE(pipeline.wants(constants(7)));
  EXPECT_TRUE(pipeline.wants(constants(0)));
  EXPECT_FALSE(pipeline.wants(constants(3)));
}

TEST(CameraPipeline, CountsIdsThatChange) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  for (const std::uint32_t id : {3u, 3u, 4u, 3u}) (void)pipeline.process(sample(params(1, id)), 0);
  EXPECT_EQ(pipeline.statistics().id_changes, 2u);
}

TEST(CameraPipeline, NoCameraInfoForALensThatFoldsTheImage) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  auto p = params(1);
  p.k1 = -0.05;  // folds at r = sqrt(1 / 0.15) = 2.6 mm, the corner is at 5.5 mm
  const auto made = pipeline.process(sample(p), 0);
  EXPECT_TRUE(made.pose && made.params);
  EXPECT_FALSE(made.calibration);
  EXPECT_EQ(pipeline.statistics().info_reason, camera::CameraReason::not_monotonic);
}

TEST(CameraPipeline, DisabledOutputsAreNotMade) {
  CameraOptions configured;
  configured.publish_tf = false;
  configured.publish_camera_info = false;
  CameraPipeline pipeline(configured, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  const auto made = pipeline.process(sample(params(1)), 0);
  EXPECT_TRUE(made.params);
  EXPECT_FALSE(made.pose || made.calibration);
  EXPECT_EQ(pipeline.statistics().without_camera_info, 0u);
}

TEST(CameraPipeline, ChangesTakeEffectWithTheNextSample) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  (void)pipeline.process(sample(constants()), 0);
  EXPECT_EQ(pipeline.process(sample(params(1), today), 0).stamp, today);
  LiveOptions live;
  live.delay = 0.005;
  live.publish_tf = live.publish_camera_info = false;
  pipeline.set(live);
  const auto changed = pipeline.process(sample(params(2), today + field), 0);
  EXPECT_EQ(changed.stamp, today + field - 5'000'000);
  EXPECT_TRUE(changed.params);
  EXPECT_FALSE(changed.pose || changed.calibration);
  EXPECT_FALSE(pipeline.statistics().has_camera_info);
  pipeline.set(LiveOptions{});
  const auto back = pipeline.process(sample(params(3), today + 2 * field), 0);
  EXPECT_EQ(back.stamp, today + 2 * field);
  EXPECT_TRUE(back.pose && back.calibration);
}

TEST(CameraPipeline, PlumbBobAlwaysIfRequested) {
  auto p = params(1);
  p.k1 = 0.004;
  CameraOptions options;
  CameraPipeline automatic(options, 50);
  options.plumb_bob_tolerance = std::numeric_limits<double>::infinity();
  CameraPipeline always(options, 50);
  for (auto* pipeline : {&automatic, &always}) (void)pipeline->process(sample(constants()), 0);
  EXPECT_EQ(automatic.process(sample(p), 0).calibration.value().distortion.model,
            camera::DistortionModel::rational_polynomial);
  EXPECT_EQ(always.process(sample(p), 0).calibration.value().distortion.model, camera::DistortionModel::plumb_bob);
  EXPECT_GT(always.statistics().fit_residual, camera::plumb_bob_tolerance);
}

TEST(CameraPipeline, WithoutACounterEveryRecordIsNew) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  for (int i = 0; i < 3; ++i) {
    auto s = sample(params(0), today + i * field);
    s.has_counter = false;
    const auto made = pipeline.process(s, i);
    ASSERT_TRUE(made.params && made.pose);
    EXPECT_EQ(made.stamp, today + i * field);
    EXPECT_EQ(pipeline.statistics().last_new, i);
  }
  const auto& statistics = pipeline.statistics();
  EXPECT_EQ(statistics.sequence.accepted, 3u);
  EXPECT_EQ(statistics.sequence.duplicates, 0u);
  EXPECT_EQ(statistics.without_counter, 3u);

  // The first counter is judged as the first one, also if it is received later.
  EXPECT_TRUE(pipeline.process(sample(params(7), today + 3 * field), 0).pose);
  EXPECT_FALSE(pipeline.process(sample(params(7), today + 4 * field), 0).pose);
  EXPECT_EQ(statistics.sequence.accepted, 4u);
  EXPECT_EQ(statistics.sequence.duplicates, 1u);
}

TEST(CameraPipeline, WithoutALensOnlyThePoseIsPublished) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  ASSERT_TRUE(pipeline.process(sample(constants()), 0).constants);
  ASSERT_TRUE(pipeline.process(sample(params(1)), 0).calibration);
  auto p = params(2);
  p.fov = std::nan("");  // says nothing
  auto s = sample(p, today + field);
  s.has_lens = false;
  s.encoders.zoom = 74565;
  const auto made = pipeline.process(s, 0);
  ASSERT_TRUE(made.encoders) << "counts are published also without a lens";
  EXPECT_EQ(made.encoders->counts, (transport::LensEncoders{74565, {}, {}}));
  ASSERT_TRUE(made.pose);
  EXPECT_EQ(made.pose->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(made.stamp, today + field);
  EXPECT_FALSE(made.params || made.calibration || made.constants);
  const auto& statistics = pipeline.statistics();
  EXPECT_EQ(statistics.sequence.accepted, 2u);
  EXPECT_EQ(statistics.without_lens, 1u);
  EXPECT_FALSE(statistics.has_lens);
  EXPECT_FALSE(statistics.has_camera_info);
  EXPECT_EQ(statistics.dropped + statistics.withheld + statistics.without_camera_info, 0u);

  const auto last = pipeline.process(sample(params(3), today + 2 * field), 0);
  EXPECT_TRUE(last.calibration);
  EXPECT_FALSE(last.encoders) << "trk has none";
  EXPECT_TRUE(statistics.has_lens);
}

TEST(CameraPipeline, AnInvalidPoseIsDroppedWithoutALensAsWell) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto p = params(1);
  p.euler.x = std::nan("");
  auto s = sample(p);
  s.has_lens = false;
  EXPECT_FALSE(pipeline.process(s, 0).pose);
  EXPECT_EQ(pipeline.statistics().dropped, 1u);
}

TEST(CameraPipeline, KeepsTheEncodingAndSenderOfTheLastNewRecord) {
  CameraPipeline pipeline(CameraOptions{}, 50);
  auto s = sample(params(1));
  s.origin = "binary identified_lp64, layout guessed";
  s.sender.number = 50123;
  (void)pipeline.process(s, 0);
  s.origin = "ASCII";
  s.sender.number = 50124;
  (void)pipeline.process(s, 0);
  EXPECT_STREQ(pipeline.statistics().encoding, "binary identified_lp64, layout guessed")
      << "a duplicate was received later";
  EXPECT_EQ(pipeline.statistics().sender.number, 50123u);
}

}  // namespace trk_bridge::bridge::camera_pipeline_test
