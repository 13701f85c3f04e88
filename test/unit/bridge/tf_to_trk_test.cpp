// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/tf_to_trk.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge::tf_to_trk_test {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t start = 1'700'000'000 * second;
constexpr std::int64_t static_stamp = 0;

constexpr std::int64_t field(int n) { return start + second / 50 * n; }

TfToTrkOptions options() {
  TfToTrkOptions o;
  o.chip.chip_width = 9.6;
  o.chip.chip_height = 5.4;
  o.focdist = 3;
  o.aperture = 2.8;
  return o;
}

/// fx = 2000 pixels of 1920 on 9.6 mm: image distance 10 mm.
CameraInfo info(double fx = 2000) {
  CameraInfo i;
  i.width = 1920;
  i.height = 1080;
  i.distortion_model = "plumb_bob";
  i.d = {0, 0, 0, 0, 0};
  i.k = {fx, 0, 959.5, 0, fx, 539.5, 0, 0, 1};
  return i;
}

Eigen::Isometry3d pose() {
  Eigen::Isometry3d studio_T_camera = Eigen::Isometry3d::Identity();
  studio_T_camera.linear() = camera::rotation_of({30, -5, 2});
  studio_T_camera.translation() << 1, 2, 3;
  return studio_T_camera;
}

TEST(TfToTrk, PoseLensAndParametersInOneSet) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  const auto made = converter.make(pose(), field(0), 9);
  ASSERT_TRUE(made && made->constants);
  const auto& p = made->params;
  EXPECT_EQ(p.id, 0u) << "up to the outlet";
  EXPECT_EQ(p.counter, 1u);
  EXPECT_EQ(p.format, std::uint32_t{wire::euler});
  EXPECT_NEAR(p.euler.x, 1, 1e-12);
  EXPECT_NEAR(p.euler.y, 2, 1e-12);
  EXPECT_NEAR(p.euler.z, 3, 1e-12);
  EXPECT_NEAR(p.euler.pan, 30, 1e-9);
  EXPECT_NEAR(p.euler.tilt, -5, 1e-9);
  EXPECT_NEAR(p.euler.roll, 2, 1e-9);
  EXPECT_NEAR(p.fov, 10, 1e-12);
  EXPECT_NEAR(p.center_x, 0, 1e-12);
  EXPECT_EQ(p.focdist, 3);
  EXPECT_EQ(p.aperture, 2.8);
  EXPECT_EQ(*made->constants, (wire::CameraConstants{0, 1920, 1080, 0, 0, 0, 0, 9.6, 5.4, 0, 0}));
  EXPECT_EQ(converter.statistics().last_set, 9);
  EXPECT_EQ(converter.statistics().last_stamp, field(0));
}

TEST(TfToTrk, AnOpticalFrameIsConvertedToCameraAxes) {
  auto configured = options();
  // x right, y down, z forward in x right, y forward, z up.
  Eigen::Isometry3d camera_T_optical = Eigen::Isometry3d::Identity();
  camera_T_optical.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  configured.frame_T_camera = camera_T_optical.inverse();
  TfToTrk converter(configured);
  converter.use(info(), field(0), 0);
  // The optical frame of a camera that looks along the studio's y axis: a turn of -90 degrees about x.
  Eigen::Isometry3d optical(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
  const auto made = converter.make(optical, field(0), 0);
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->params.euler.pan, 0, 1e-9);
  EXPECT_NEAR(made->params.euler.tilt, 0, 1e-9);
  EXPECT_NEAR(made->params.euler.roll, 0, 1e-9);
}

TEST(TfToTrk, CountsUpByOneWithEverySet) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  for (int n = 1; n <= 5; ++n) {
    const auto made = converter.make(pose(), field(3 * n), 0);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->params.counter, static_cast<std::uint64_t>(n));
    EXPECT_EQ(made->constants.has_value(), n == 1);
  }
}

TEST(TfToTrk, OnlyNewerPosesAreNewUntilTheClockIsSet) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  EXPECT_TRUE(converter.is_new(field(10)));
  ASSERT_TRUE(converter.make(pose(), field(10), 0));
  EXPECT_FALSE(converter.is_new(field(10)));
  EXPECT_FALSE(converter.is_new(field(9)));
  EXPECT_TRUE(converter.is_new(field(11)));
  EXPECT_FALSE(converter.is_new(start - 5 * second));
  EXPECT_TRUE(converter.is_new(static_stamp)) << "static transforms alone are never stale";
  converter.restart();
  EXPECT_TRUE(converter.is_new(start - 5 * second));
  ASSERT_TRUE(converter.make(pose(), start - 5 * second, 0));
  EXPECT_FALSE(converter.is_new(start - 5 * second));
  EXPECT_TRUE(converter.is_new(start - 4 * second));
}

TEST(TfToTrk, AClockThatIsSetBackKeepsTheNewestLensAndWaitsForTheNext) {
  TfToTrk converter(options());
  for (int n = 0; n < 10; ++n) converter.use(info(2000 + 200 * n), field(n), 0);
  ASSERT_TRUE(converter.make(pose(), field(9), 0));
  converter.restart();
  const std::int64_t earlier = start - 60 * second;
  EXPECT_TRUE(converter.expects_lens(earlier));
  EXPECT_NEAR(converter.make(pose(), earlier, 0)->params.fov, 19, 1e-9);
  converter.use(info(4000), earlier + second / 50, 0);
  EXPECT_NEAR(converter.make(pose(), earlier + second / 50, 0)->params.fov, 20, 1e-9);
}

TEST(TfToTrk, IfClocksDifferTheNewestLensIsUsed) {
  TfToTrk converter(options());
  for (int n = 0; n < 100; ++n) converter.use(info(2000 + 20 * n), field(n), 0);
  EXPECT_NEAR(converter.make(pose(), start - 60 * second, 0)->params.fov, 19.9, 1e-9);
  EXPECT_NEAR(converter.make(pose(), start + 3600 * second, 0)->params.fov, 19.9, 1e-9);
}

TEST(TfToTrk, WithoutALensThereIsNoSet) {
  TfToTrk converter(options());
  EXPECT_FALSE(converter.make(pose(), field(0), 0));
  EXPECT_EQ(converter.statistics().sets, 0u);
  converter.use(info(), field(1), 0);
  const auto made = converter.make(pose(), field(1), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->params.counter, 1u) << "what was not sent was not counted";
}

TEST(TfToTrk, ALensIsUsedForThePoseWithItsStamp) {
  TfToTrk converter(options());
  for (int n = 0; n < 10; ++n) converter.use(info(2000 + 200 * n), field(n), 0);
  EXPECT_NEAR(converter.make(pose(), field(4), 0)->params.fov, 14, 1e-9);
  EXPECT_NEAR(converter.make(pose(), field(6) + second / 200, 0)->params.fov, 16, 1e-9) << "the previous one";
  EXPECT_NEAR(converter.make(pose(), field(50), 0)->params.fov, 19, 1e-9);
  EXPECT_NEAR(converter.make(pose(), field(-9), 0)->params.fov, 10, 1e-9) << "the oldest one";
  EXPECT_NEAR(converter.make(pose(), static_stamp, 0)->params.fov, 19, 1e-9);
}

TEST(TfToTrk, ExpectsALensAsLongAsTheyArriveWithThePoses) {
  TfToTrk converter(options());
  EXPECT_TRUE(converter.expects_lens(field(0)));
  converter.use(info(), field(0), 0);
  EXPECT_FALSE(converter.expects_lens(field(0)));
  ASSERT_TRUE(converter.make(pose(), field(0), 0));
  EXPECT_TRUE(converter.expects_lens(field(1)));
  ASSERT_TRUE(converter.make(pose(), field(1), 0)) << "it was not received";
  EXPECT_FALSE(converter.expects_lens(field(2))) << "and is no longer waited for";
  converter.use(info(), field(2), 0);
  ASSERT_TRUE(converter.make(pose(), field(2), 0));
  EXPECT_TRUE(converter.expects_lens(field(3))) << "until they are synchronous again";
}

TEST(TfToTrk, APoseThatIsNotFiniteIsDropped) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  auto nowhere = pose();
  nowhere.translation().x() = std::nan("");
  EXPECT_FALSE(converter.make(nowhere, field(0), 0));
  EXPECT_EQ(converter.statistics().dropped, 1u);
  EXPECT_EQ(converter.statistics().drop_reason, camera::CameraReason::not_finite);
  const auto made = converter.make(pose(), field(0), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->params.counter, 1u);
  EXPECT_TRUE(made->constants);
}

TEST(TfToTrk, APoseThatWasDroppedIsNotNewAgain) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  auto nowhere = pose();
  nowhere.translation().x() = std::nan("");
  EXPECT_FALSE(converter.make(nowhere, field(1), 0));
  EXPECT_FALSE(converter.is_new(field(1)));
  EXPECT_TRUE(converter.is_new(field(2)));
  EXPECT_EQ(converter.statistics().last_stamp, 0) << "belongs to no set";
}

TEST(TfToTrk, FitsOnlyChangedCalibrations) {
  TfToTrk converter(options());
  auto i = info();
  for (int n = 0; n < 10; ++n) converter.use(i, field(n), 0);
  EXPECT_EQ(converter.statistics().fits, 1u);
  EXPECT_EQ(converter.statistics().infos, 10u);
  i.d[0] = 0.01;
  converter.use(i, field(10), 0);
  i.k[0] += 1;
  converter.use(i, field(11), 0);
  EXPECT_EQ(converter.statistics().fits, 3u);
}

TEST(TfToTrk, TheImageSizeOfCameraInfoIsUsedForTheConstants) {
  auto configured = options();
  configured.chip.blank_left = 20;
  configured.chip.blank_right = 10;
  TfToTrk converter(configured);
  auto i = info();
  converter.use(i, field(0), 0);
  auto made = converter.make(pose(), field(0), 0);
  ASSERT_TRUE(made->constants);
  EXPECT_EQ(made->constants->blank_left, 20);
  const auto sent = camera::constants_for(*made->constants, wire::euler | wire::ignore_blank | wire::keep_aspect);
  EXPECT_NEAR(sent.fake_chip_height, 5.4 * 1920 / 1890, 1e-12);
  i.width = 1280;
  i.height = 720;
  converter.use(i, field(1), 0);
  made = converter.make(pose(), field(1), 0);
  ASSERT_TRUE(made->constants) << "changed";
  EXPECT_EQ(made->constants->image_width, 1280);
}

TEST(TfToTrk, FocusAndApertureOfTheLensTopic) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  converter.use_lens(12, 4);
  converter.use_lens(std::nan(""), 5);
  converter.use_lens(13, std::numeric_limits<double>::infinity());
  const auto made = converter.make(pose(), field(0), 0);
  EXPECT_EQ(made->params.focdist, 12);
  EXPECT_EQ(made->params.aperture, 4);
  EXPECT_NEAR(made->params.fov, 10, 1e-12);
  EXPECT_EQ(converter.statistics().bad_lenses, 2u);
}

TEST(TfToTrk, MeasuresWhatTrkCannotRepresentOfTheLens) {
  TfToTrk converter(options());
  auto i = info();
  i.d = {-0.1, 0.01, 0.002, 0, 0};
  i.k[4] = 2010;
  converter.use(i, field(0), 0);
  const auto& statistics = converter.statistics();
  EXPECT_GT(statistics.tangential, 0.5);
  // Rows reach 540 pixels from the axis, and fy is 0.5 % off.
  EXPECT_NEAR(statistics.aspect, 540 * (1 - 2000.0 / 2010), 0.01);
  EXPECT_LT(statistics.residual, 1);
}

struct Refused {
  const char* name;
  void (*spoil)(CameraInfo&);
  InfoReason reason;
};

class RefusesCameraInfo : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusesCameraInfo, NothingIsSentUntilAnotherArrives) {
  TfToTrk converter(options());
  converter.use(info(), field(0), 0);
  auto bad = info();
  GetParam().spoil(bad);
  converter.use(bad, field(1), 0);
  EXPECT_FALSE(converter.make(pose(), field(1), 0)) << "not with the lens before";
  EXPECT_TRUE(converter.statistics().info_is_refused);
  EXPECT_EQ(converter.statistics().info_fault.reason, GetParam().reason);
  EXPECT_FALSE(describe(converter.statistics().info_fault).empty());
  converter.use(info(), field(2), 0);
  EXPECT_TRUE(converter.make(pose(), field(2), 0));
  EXPECT_FALSE(converter.statistics().info_is_refused);
  EXPECT_EQ(converter.statistics().refused_infos, 1u);
}

const Refused refused_ones[] = {
    {"NoWidth", [](CameraInfo& i) { i.width = 0; }, InfoReason::no_size},
    {"HugeHeight", [](CameraInfo& i) { i.height = 0x80000000; }, InfoReason::no_size},
    {"Fisheye", [](CameraInfo& i) { i.distortion_model = "equidistant"; }, InfoReason::unknown_model},
    {"NoModel", [](CameraInfo& i) { i.distortion_model = ""; }, InfoReason::unknown_model},
    {"TooMany", [](CameraInfo& i) { i.d.resize(8); }, InfoReason::coefficients},
    {"TooFew", [](CameraInfo& i) { i.distortion_model = "rational_polynomial"; }, InfoReason::coefficients},
    {"Uncalibrated", [](CameraInfo& i) { i.k[0] = 0; }, InfoReason::no_lens},
    {"NotFinite", [](CameraInfo& i) { i.d[1] = std::nan(""); }, InfoReason::no_lens},
};
INSTANTIATE_TEST_SUITE_P(One, RefusesCameraInfo, ::testing::ValuesIn(refused_ones),
                         [](const auto& test) { return test.param.name; });

TEST(TfToTrk, NoModelWithoutCoefficientsIsAccepted) {
  TfToTrk converter(options());
  auto i = info();
  i.distortion_model = "";
  i.d.clear();
  converter.use(i, field(0), 0);
  EXPECT_TRUE(converter.make(pose(), field(0), 0));
}

}  // namespace trk_bridge::bridge::tf_to_trk_test
