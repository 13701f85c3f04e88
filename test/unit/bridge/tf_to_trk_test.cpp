#include "ros/tf_to_trk.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "trk_bridge/ros/frames.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

const ::ros::Time start(1'700'000'000, 0);

::ros::Time field(int n) { return start + ::ros::Duration(0.02 * n); }

TfToTrkOptions options() {
  TfToTrkOptions o;
  o.chip.chip_width = 9.6;
  o.chip.chip_height = 5.4;
  o.focdist = 3;
  o.aperture = 2.8;
  return o;
}

/// fx = 2000 pixels of 1920 on 9.6 mm: image distance 10 mm.
sensor_msgs::CameraInfo info(const ::ros::Time& stamp, double fx = 2000) {
  sensor_msgs::CameraInfo m;
  m.header.stamp = stamp;
  m.width = 1920;
  m.height = 1080;
  m.distortion_model = "plumb_bob";
  m.D = {0, 0, 0, 0, 0};
  m.K = {fx, 0, 959.5, 0, fx, 539.5, 0, 0, 1};
  return m;
}

geometry_msgs::TransformStamped pose(const ::ros::Time& stamp) {
  geometry_msgs::TransformStamped m;
  m.header.stamp = stamp;
  Eigen::Isometry3d studio_T_camera = Eigen::Isometry3d::Identity();
  studio_T_camera.linear() = camera::rotation_of({30, -5, 2});
  studio_T_camera.translation() << 1, 2, 3;
  m.transform = to_transform(studio_T_camera);
  return m;
}

TEST(TfToTrk, PoseLensAndParametersInOneSet) {
  OutgoingForm form;
  form.id = 7;
  TfToTrk converter(form, options());
  converter.take(info(field(0)), 0);
  const auto made = converter.make(pose(field(0)), 9);
  ASSERT_TRUE(made.params && made.constants);
  const auto& p = *made.params;
  EXPECT_EQ(p.id, 7u);
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
  EXPECT_EQ(*made.constants, (wire::CameraConstants{7, 1920, 1080, 0, 0, 0, 0, 9.6, 5.4, 9.6, 5.4}));
  EXPECT_EQ(converter.statistics().outgoing.last_set, 9);
  EXPECT_EQ(converter.statistics().last_stamp, static_cast<std::int64_t>(field(0).toNSec()));
}

TEST(TfToTrk, AnOpticalFrameIsTurnedBack) {
  auto configured = options();
  configured.camera_frame_is_optical = true;
  TfToTrk converter({}, configured);
  converter.take(info(field(0)), 0);
  auto optical = pose(field(0));
  // x right, y down, z forward of a camera that looks along the studio's y axis: a turn of -90 degrees about x.
  optical.transform.rotation.x = -std::sqrt(0.5);
  optical.transform.rotation.y = optical.transform.rotation.z = 0;
  optical.transform.rotation.w = std::sqrt(0.5);
  const auto made = converter.make(optical, 0);
  ASSERT_TRUE(made.params);
  EXPECT_NEAR(made.params->euler.pan, 0, 1e-9);
  EXPECT_NEAR(made.params->euler.tilt, 0, 1e-9);
  EXPECT_NEAR(made.params->euler.roll, 0, 1e-9);
}

TEST(TfToTrk, CountsUpByOneWithEverySet) {
  TfToTrk converter({}, options());
  converter.take(info(field(0)), 0);
  for (int n = 1; n <= 5; ++n) {
    const auto made = converter.make(pose(field(3 * n)), 0);
    ASSERT_TRUE(made.params);
    EXPECT_EQ(made.params->counter, static_cast<std::uint64_t>(n));
    EXPECT_EQ(made.constants.has_value(), n == 1);
  }
}

TEST(TfToTrk, OnlyNewerPosesAreNewUnlessTimeJumpedBack) {
  TfToTrk converter({}, options());
  converter.take(info(field(0)), 0);
  EXPECT_TRUE(converter.is_new(field(10)));
  ASSERT_TRUE(converter.make(pose(field(10)), 0).params);
  EXPECT_FALSE(converter.is_new(field(10)));
  EXPECT_FALSE(converter.is_new(field(9)));
  EXPECT_TRUE(converter.is_new(field(11)));
  EXPECT_TRUE(converter.is_new(start - ::ros::Duration(5)));
  EXPECT_TRUE(converter.is_new(::ros::Time())) << "static transforms alone are never stale";
}

TEST(TfToTrk, NothingWithoutALens) {
  TfToTrk converter({}, options());
  EXPECT_FALSE(converter.make(pose(field(0)), 0).params);
  EXPECT_EQ(converter.statistics().outgoing.sets, 0u);
  converter.take(info(field(1)), 0);
  const auto made = converter.make(pose(field(1)), 0);
  ASSERT_TRUE(made.params);
  EXPECT_EQ(made.params->counter, 1u) << "what was not sent was not counted";
}

TEST(TfToTrk, ALensGoesWithThePoseOfItsStamp) {
  TfToTrk converter({}, options());
  for (int n = 0; n < 10; ++n) converter.take(info(field(n), 2000 + 200 * n), 0);
  EXPECT_NEAR(converter.make(pose(field(4)), 0).params->fov, 14, 1e-9);
  EXPECT_NEAR(converter.make(pose(field(6) + ::ros::Duration(0.005)), 0).params->fov, 16, 1e-9) << "the one before it";
  EXPECT_NEAR(converter.make(pose(field(50)), 0).params->fov, 19, 1e-9);
  EXPECT_NEAR(converter.make(pose(start - ::ros::Duration(9)), 0).params->fov, 10, 1e-9) << "the oldest there is";
  EXPECT_NEAR(converter.make(pose(::ros::Time()), 0).params->fov, 19, 1e-9);
}

TEST(TfToTrk, ExpectsALensAsLongAsTheyComeWithThePoses) {
  TfToTrk converter({}, options());
  EXPECT_TRUE(converter.expects_lens(field(0)));
  converter.take(info(field(0)), 0);
  EXPECT_FALSE(converter.expects_lens(field(0)));
  ASSERT_TRUE(converter.make(pose(field(0)), 0).params);
  EXPECT_TRUE(converter.expects_lens(field(1)));
  ASSERT_TRUE(converter.make(pose(field(1)), 0).params) << "it did not come";
  EXPECT_FALSE(converter.expects_lens(field(2))) << "and is not waited for any more";
  converter.take(info(field(2)), 0);
  ASSERT_TRUE(converter.make(pose(field(2)), 0).params);
  EXPECT_TRUE(converter.expects_lens(field(3))) << "until they come in step again";
}

TEST(TfToTrk, FitsOnlyWhatChanged) {
  TfToTrk converter({}, options());
  auto m = info(field(0));
  for (int n = 0; n < 10; ++n) {
    m.header.stamp = field(n);
    converter.take(m, 0);
  }
  EXPECT_EQ(converter.statistics().fits, 1u);
  EXPECT_EQ(converter.statistics().infos, 10u);
  m.D[0] = 0.01;
  converter.take(m, 0);
  m.K[0] += 1;
  converter.take(m, 0);
  EXPECT_EQ(converter.statistics().fits, 3u);
}

TEST(TfToTrk, ThePictureOfCameraInfoMakesTheConstants) {
  auto configured = options();
  configured.chip.blank_left = 20;
  configured.chip.blank_right = 10;
  OutgoingForm form;
  form.format = wire::euler | wire::ignore_blank | wire::keep_aspect;
  TfToTrk converter(form, configured);
  auto m = info(field(0));
  converter.take(m, 0);
  auto made = converter.make(pose(field(0)), 0);
  ASSERT_TRUE(made.constants);
  EXPECT_EQ(made.constants->blank_left, 20);
  EXPECT_NEAR(made.constants->fake_chip_height, 5.4 * 1920 / 1890, 1e-12);
  m.header.stamp = field(1);
  m.width = 1280;
  m.height = 720;
  converter.take(m, 0);
  made = converter.make(pose(field(1)), 0);
  ASSERT_TRUE(made.constants) << "changed";
  EXPECT_EQ(made.constants->image_width, 1280);
}

TEST(TfToTrk, FocusAndApertureOfTheLensTopic) {
  TfToTrk converter({}, options());
  converter.take(info(field(0)), 0);
  trk_bridge::CameraParams lens;
  lens.focdist = 12;
  lens.aperture = 4;
  lens.fov = 99;
  converter.take_lens(lens);
  lens.focdist = std::nan("");
  converter.take_lens(lens);
  const auto made = converter.make(pose(field(0)), 0);
  EXPECT_EQ(made.params->focdist, 12);
  EXPECT_EQ(made.params->aperture, 4);
  EXPECT_NEAR(made.params->fov, 10, 1e-12);
  EXPECT_EQ(converter.statistics().bad_lenses, 1u);
}

TEST(TfToTrk, TellsWhatTrkCannotTellOfTheLens) {
  TfToTrk converter({}, options());
  auto m = info(field(0));
  m.D = {-0.1, 0.01, 0.002, 0, 0};
  m.K[4] = 2010;
  converter.take(m, 0);
  const auto& statistics = converter.statistics();
  EXPECT_GT(statistics.tangential, 0.5);
  // Rows reach 540 pixels from the axis, and fy is 0.5 % off.
  EXPECT_NEAR(statistics.aspect, 540 * (1 - 2000.0 / 2010), 0.01);
  EXPECT_LT(statistics.residual, 1);
}

struct Refused {
  const char* name;
  void (*spoil)(sensor_msgs::CameraInfo&);
  InfoReason reason;
};

class RefusesCameraInfo : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusesCameraInfo, NothingIsSentUntilAnotherComes) {
  TfToTrk converter({}, options());
  converter.take(info(field(0)), 0);
  auto bad = info(field(1));
  GetParam().spoil(bad);
  converter.take(bad, 0);
  EXPECT_FALSE(converter.make(pose(field(1)), 0).params) << "not with the lens before";
  EXPECT_TRUE(converter.statistics().info_is_refused);
  EXPECT_EQ(converter.statistics().info_fault.reason, GetParam().reason);
  EXPECT_FALSE(describe(converter.statistics().info_fault).empty());
  converter.take(info(field(2)), 0);
  EXPECT_TRUE(converter.make(pose(field(2)), 0).params);
  EXPECT_FALSE(converter.statistics().info_is_refused);
  EXPECT_EQ(converter.statistics().refused_infos, 1u);
}

const Refused refused_ones[] = {
    {"NoWidth", [](sensor_msgs::CameraInfo& m) { m.width = 0; }, InfoReason::no_size},
    {"HugeHeight", [](sensor_msgs::CameraInfo& m) { m.height = 0x80000000; }, InfoReason::no_size},
    {"Binned", [](sensor_msgs::CameraInfo& m) { m.binning_x = 2; }, InfoReason::binned},
    {"Region", [](sensor_msgs::CameraInfo& m) { m.roi.x_offset = 8; }, InfoReason::region},
    {"PartRegion", [](sensor_msgs::CameraInfo& m) { m.roi.width = m.roi.height = 100; }, InfoReason::region},
    {"Fisheye", [](sensor_msgs::CameraInfo& m) { m.distortion_model = "equidistant"; }, InfoReason::unknown_model},
    {"NoModel", [](sensor_msgs::CameraInfo& m) { m.distortion_model = ""; }, InfoReason::unknown_model},
    {"TooMany", [](sensor_msgs::CameraInfo& m) { m.D.resize(8); }, InfoReason::coefficients},
    {"TooFew", [](sensor_msgs::CameraInfo& m) { m.distortion_model = "rational_polynomial"; },
     InfoReason::coefficients},
    {"Uncalibrated", [](sensor_msgs::CameraInfo& m) { m.K[0] = 0; }, InfoReason::no_lens},
    {"NotFinite", [](sensor_msgs::CameraInfo& m) { m.D[1] = std::nan(""); }, InfoReason::no_lens},
};
INSTANTIATE_TEST_SUITE_P(One, RefusesCameraInfo, ::testing::ValuesIn(refused_ones),
                         [](const auto& test) { return test.param.name; });

TEST(TfToTrk, AWholeRegionAndNoModelWithoutCoefficientsAreAccepted) {
  TfToTrk converter({}, options());
  auto m = info(field(0));
  m.binning_x = m.binning_y = 1;
  m.roi.width = 1920;
  m.roi.height = 1080;
  m.distortion_model = "";
  m.D.clear();
  converter.take(m, 0);
  EXPECT_TRUE(converter.make(pose(field(0)), 0).params);
}

}  // namespace
}  // namespace trk_bridge::ros1
