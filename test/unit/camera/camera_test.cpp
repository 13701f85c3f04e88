// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/camera.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>

#include "random_cameras.h"

namespace trk_bridge::camera::camera_test {

using ::testing::DoubleNear;
using wire::CameraConstants;
using wire::CameraParams;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const CameraConstants valid_constants{0, 720, 576, 10, 6, 2, 0, 9.59, 7.19, 0, 0};

CameraParams euler_params(double pan, double tilt, double roll) {
  CameraParams params;
  params.format = wire::euler;
  params.euler = {1, 2, 3, pan, tilt, roll};
  params.fov = 10;
  return params;
}

/// A level camera at the studio's origin.
CameraParams matrix_params() {
  CameraParams params;
  params.matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  params.fov = 10;
  return params;
}

template <typename T>
void expect_error(const Result<T>& result, CameraReason reason) {
  ASSERT_FALSE(result) << "expected: " << describe(reason);
  EXPECT_EQ(result.error(), reason) << describe(result.error());
}

TEST(Formats, EveryMeaningfulFormatRoundTripsACamera) {
  test::RandomCameras random;
  const auto masks = test::meaningful_masks();
  ASSERT_EQ(masks.size(), 768U);
  for (const std::uint32_t mask : masks) {
    SCOPED_TRACE("mask " + std::to_string(mask));
    for (int i = 0; i < 4; ++i) {
      const Camera camera = random.camera();
      const CameraConstants constants = constants_for(random.constants(), mask);
      const auto params = encode(camera, mask, &constants);
      ASSERT_TRUE(params) << describe(params.error());
      EXPECT_EQ(params->format, mask);
      const auto back = decode(*params, &constants);
      ASSERT_TRUE(back) << describe(back.error());
      EXPECT_LE((back->pose.matrix() - camera.pose.matrix()).cwiseAbs().maxCoeff(), 20 * 1e-9);
      EXPECT_LE((back->pose.linear() - camera.pose.linear()).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_NEAR(back->lens.image_distance, camera.lens.image_distance, 1e-9 * camera.lens.image_distance);
      EXPECT_LE((back->lens.center_shift - camera.lens.center_shift).norm(), 1e-9);
      EXPECT_EQ(back->lens.k1, camera.lens.k1);
      EXPECT_EQ(back->lens.k2, camera.lens.k2);
      EXPECT_EQ(back->lens.focdist, camera.lens.focdist);
      EXPECT_EQ(back->lens.aperture, camera.lens.aperture);
    }
  }
}

TEST(Formats, ThatCannotBeWrittenAreRefused) {
  expect_error(encode(Camera{}, 0x400, &valid_constants), CameraReason::bad_format);
  expect_error(encode(Camera{}, 0x80000000, &valid_constants), CameraReason::bad_format);
  expect_error(encode(Camera{}, wire::field_of_view | wire::vertical | wire::diagonal, &valid_constants),
               CameraReason::bad_format);
}

TEST(Formats, WithUnknownBitsOrVerticalAndDiagonalAreRead) {
  CameraParams params = matrix_params();
  params.format = wire::field_of_view | wire::vertical;
  params.fov = 40;
  const auto vertical = decode_lens(params, &valid_constants);
  params.format |= wire::diagonal | 0xF0000000;
  const auto both = decode_lens(params, &valid_constants);
  ASSERT_TRUE(vertical && both);
  EXPECT_EQ(both->image_distance, vertical->image_distance);
}

TEST(Axes, OfALevelCameraInEveryMatrixFormat) {
  // A camera at right wall 1, back wall 2, up 3, panned 90 degrees to the left: it looks along -x, its right is +y.
  const Camera camera{
      Eigen::Translation3d(1, 2, 3) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ())), Lens{10}};
  struct Expected {
    std::uint32_t format;
    std::array<double, 16> columns;
  };
  const Expected formats[] = {
      {0, {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}},
      // Right is the studio's -z, up is y, and the third axis looks backwards, to the right wall.
      {wire::camera_y_up | wire::studio_y_up, {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 3, -2, 1}},
      {wire::camera_y_up, {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 2, 3, 1}},
      {wire::studio_y_up, {0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 1, 3, -2, 1}},
      // The studio's origin lies 2 to the left of the camera, 1 ahead and 3 below.
      {wire::studio_to_camera, {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, -2, 1, -3, 1}},
  };
  for (const auto& expected : formats) {
    SCOPED_TRACE("format " + std::to_string(expected.format));
    const auto params = encode(camera, expected.format, nullptr);
    ASSERT_TRUE(params) << describe(params.error());
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(params->matrix[i], expected.columns[i], 1e-15) << "element " << i;
  }
  const auto euler = encode(camera, wire::euler | wire::studio_y_up, nullptr);
  ASSERT_TRUE(euler);
  EXPECT_EQ(euler->euler.x, 1);
  EXPECT_EQ(euler->euler.y, 3);
  EXPECT_EQ(euler->euler.z, -2);
  EXPECT_NEAR(euler->euler.pan, 90, 1e-13);
}

TEST(Angles, AreExactAtRightAngles) {
  const Eigen::Matrix3d quarter = rotation_of({90, 0, 0});
  EXPECT_EQ(quarter(0, 0), 0);
  EXPECT_EQ(quarter(1, 0), 1);
  EXPECT_EQ(rotation_of({360.0 * 1000 + 30, 0, 0}), rotation_of({30, 0, 0}));
  const PanTiltRoll angles = pan_tilt_roll(rotation_of({180, 0, -90}));
  EXPECT_EQ(angles.pan, 180);
  EXPECT_EQ(angles.tilt, 0);
  EXPECT_EQ(angles.roll, -90);
}

TEST(Angles, BeyondTheCanonicalRangeAreTheSameRotation) {
  struct Same {
    PanTiltRoll given, canonical;
  };
  const Same pairs[] = {
      {{725, 0, 0}, {5, 0, 0}},       {{0, 100, 0}, {180, 80, 180}}, {{10, -135, 20}, {-170, -45, -160}},
      {{-180, 10, 0}, {180, 10, 0}},  {{0, 0, 540}, {0, 0, 180}},    {{-540, 0, -180}, {180, 0, 180}},
      {{0, 360 + 30, 0}, {0, 30, 0}},
  };
  for (const auto& same : pairs) {
    const PanTiltRoll angles = pan_tilt_roll(rotation_of(same.given));
    EXPECT_NEAR(angles.pan, same.canonical.pan, 1e-12);
    EXPECT_NEAR(angles.tilt, same.canonical.tilt, 1e-12);
    EXPECT_NEAR(angles.roll, same.canonical.roll, 1e-12);
  }
}

TEST(Angles, AtGimbalLockAreInPan) {
  const PanTiltRoll up = pan_tilt_roll(rotation_of({30, 90, 40}));
  EXPECT_NEAR(up.pan, 70, 1e-9);
  EXPECT_NEAR(up.tilt, 90, 1e-9);
  EXPECT_EQ(up.roll, 0);
  const PanTiltRoll down = pan_tilt_roll(rotation_of({30, -90, 40}));
  EXPECT_NEAR(down.pan, -10, 1e-9);
  EXPECT_NEAR(down.tilt, -90, 1e-9);
  EXPECT_EQ(down.roll, 0);
}

TEST(Angles, NearGimbalLockAreStillTheRotation) {
  for (double off = 1e-16; off < 1; off *= 7) {
    for (const double tilt : {90 - off, -90 + off, 90 + off}) {
      const Eigen::Matrix3d rotation = rotation_of({123, tilt, -77});
      const Eigen::Matrix3d back = rotation_of(pan_tilt_roll(rotation));
      EXPECT_LE((back - rotation).cwiseAbs().maxCoeff(), 1e-9) << "tilt " << tilt;
    }
  }
}

TEST(Pose, OfAnInexactMatrixIsTheNearestRotation) {
  test::RandomCameras random;
  for (int i = 0; i < 100; ++i) {
    const Camera camera = random.camera();
    auto params = encode(camera, wire::studio_to_camera, nullptr);
    ASSERT_TRUE(params);
    for (double& element : params->matrix) element = std::round(element * 1e8) / 1e8;
    const auto pose = decode_pose(*params);
    ASSERT_TRUE(pose) << describe(pose.error());
    const Eigen::Matrix3d r = pose->linear();
    EXPECT_LE((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_GT(r.determinant(), 0);
    EXPECT_LE((r - camera.pose.linear()).cwiseAbs().maxCoeff(), 2e-8);
    EXPECT_LE((pose->translation() - camera.pose.translation()).norm(), 2e-6);
  }
}

TEST(Pose, ThatIsInvalidIsRefused) {
  struct Wrong {
    std::size_t element;
    double value;
  };
  const Wrong wrong[] = {{0, -1}, {0, 1.01}, {4, 0.01}, {0, 0}, {15, 0}, {3, 0.01}, {15, 1.01}};
  for (const auto& w : wrong) {
    CameraParams params = matrix_params();
    params.matrix[w.element] = w.value;
    expect_error(decode_pose(params), CameraReason::not_a_rotation);
    expect_error(decode(params, nullptr), CameraReason::not_a_rotation);
  }
  Camera camera{Eigen::Isometry3d::Identity(), Lens{10}};
  camera.pose.linear() *= 1.1;
  expect_error(encode(camera, wire::euler, nullptr), CameraReason::not_a_rotation);
}

TEST(Pose, ThatOverflowsIsRefused) {
  CameraParams params = matrix_params();
  params.format = wire::studio_to_camera;
  const double half = std::sqrt(0.5);
  params.matrix = {half, half, 0, 0, -half, half, 0, 0, 0, 0, 1, 0, 1.7e308, 1.7e308, 0, 1};
  expect_error(decode_pose(params), CameraReason::not_finite);
}

TEST(Numbers, ThatAreNotFiniteAreRefusedInEveryField) {
  double wire::Euler::*const euler_fields[] = {&wire::Euler::x,   &wire::Euler::y,    &wire::Euler::z,
                                               &wire::Euler::pan, &wire::Euler::tilt, &wire::Euler::roll};
  double CameraParams::*const lens_fields[] = {&CameraParams::fov,     &CameraParams::center_x, &CameraParams::center_y,
                                               &CameraParams::k1,      &CameraParams::k2,       &CameraParams::focdist,
                                               &CameraParams::aperture};
  for (const double bad : {nan, infinity, -infinity}) {
    for (const auto field : euler_fields) {
      CameraParams params = euler_params(0, 0, 0);
      params.euler.*field = bad;
      expect_error(decode(params, nullptr), CameraReason::not_finite);
    }
    for (const auto field : lens_fields) {
      CameraParams params = euler_params(0, 0, 0);
      params.*field = bad;
      expect_error(decode(params, nullptr), CameraReason::not_finite);
    }
    for (std::size_t i = 0; i < 16; ++i) {
      CameraParams params = matrix_params();
      params.matrix[i] = bad;
      expect_error(decode(params, nullptr), CameraReason::not_finite);
    }
    Camera camera{Eigen::Isometry3d::Identity(), Lens{10}};
    camera.pose.translation().y() = bad;
    expect_error(encode(camera, wire::euler, nullptr), CameraReason::not_finite);
    expect_error(encode(Camera{Eigen::Isometry3d::Identity(), Lens{bad}}, wire::euler, nullptr),
                 CameraReason::not_finite);
    expect_error(encode(Camera{Eigen::Isometry3d::Identity(), Lens{10, {0, bad}}}, wire::euler, nullptr),
                 CameraReason::not_finite);
    expect_error(encode(Camera{Eigen::Isometry3d::Identity(), Lens{10, {0, 0}, 0, bad}}, wire::euler, nullptr),
                 CameraReason::not_finite);
  }
}

TEST(Numbers, AreNeverWrittenAsNegativeZero) {
  Camera camera{Eigen::Isometry3d::Identity(), Lens{10, {-0.0, -0.0}}};
  camera.pose.translation() = Eigen::Vector3d(-0.0, -0.0, 0);
  for (const std::uint32_t mask : test::meaningful_masks()) {
    const auto params = encode(camera, mask, &valid_constants);
    ASSERT_TRUE(params);
    const auto& e = params->euler;
    for (const double value : {e.x, e.y, e.z, e.pan, e.tilt, e.roll, params->center_x, params->center_y}) {
      EXPECT_FALSE(value == 0 && std::signbit(value)) << "mask " << mask;
    }
    for (const double value : params->matrix) EXPECT_FALSE(value == 0 && std::signbit(value)) << "mask " << mask;
  }
}

TEST(FieldOfView, MustBeAnAngleOrADistance) {
  CameraParams params = matrix_params();
  for (const double distance : {0.0, -1.0}) {
    params.fov = distance;
    expect_error(decode_lens(params, nullptr), CameraReason::bad_field_of_view);
    expect_error(encode(Camera{Eigen::Isometry3d::Identity(), Lens{distance}}, 0, nullptr),
                 CameraReason::bad_field_of_view);
  }
  params.format = wire::field_of_view;
  for (const double angle : {0.0, -30.0, 180.0, 270.0}) {
    params.fov = angle;
    expect_error(decode_lens(params, &valid_constants), CameraReason::bad_field_of_view);
  }
  // Neither of these can be written as an angle and read again.
  for (const double distance : {1e-300, 5e-324}) {
    expect_error(encode(Camera{Eigen::Isometry3d::Identity(), Lens{distance}}, wire::field_of_view, &valid_constants),
                 CameraReason::bad_field_of_view);
  }
}

TEST(Constants, AreNeededOnlyIfTheFormatNeedsThem) {
  CameraParams params = matrix_params();
  EXPECT_TRUE(decode(params, nullptr));
  for (const std::uint32_t format : {wire::field_of_view, wire::ignore_blank, wire::shift_in_pixels}) {
    params.format = format;
    expect_error(decode_lens(params, nullptr), CameraReason::constants_needed);
    EXPECT_TRUE(decode_pose(params));
    EXPECT_TRUE(decode(params, &valid_constants));
    const Camera camera{Eigen::Isometry3d::Identity(), Lens{10}};
    expect_error(encode(camera, format, nullptr), CameraReason::constants_needed);
  }
}

TEST(Constants, ThatAreInvalidAreRefused) {
  const auto with = [](auto field, auto value) {
    CameraConstants constants = valid_constants;
    constants.*field = value;
    return constants;
  };
  const CameraConstants wrong[] = {
      with(&CameraConstants::image_width, 0),     with(&CameraConstants::image_height, -576),
      with(&CameraConstants::blank_left, -1),     with(&CameraConstants::blank_right, 710),
      with(&CameraConstants::blank_top, 576),     with(&CameraConstants::blank_bottom, 2147483647),
      with(&CameraConstants::chip_width, 0.0),    with(&CameraConstants::chip_height, -1.0),
      with(&CameraConstants::chip_width, nan),    with(&CameraConstants::chip_height, infinity),
      with(&CameraConstants::chip_width, 1e-310), {0, 720, 576, 2147483647, 2147483647, 0, 0, 9.59, 7.19, 0, 0}};
  CameraParams params = matrix_params();
  for (const auto& constants : wrong) {
    expect_error(check(constants), CameraReason::bad_constants);
    for (const std::uint32_t format : {wire::field_of_view, wire::ignore_blank, wire::shift_in_pixels}) {
      params.format = format;
      expect_error(decode_lens(params, &constants), CameraReason::bad_constants);
    }
    params.format = 0;
    EXPECT_TRUE(decode_lens(params, &constants)) << "a format that needs no constants does not check them";
  }
  EXPECT_TRUE(check(valid_constants));
}

TEST(Constants, AreSentWithTheFakeChipOfTheFormat) {
  CameraConstants constants{7, 720, 576, 10, 10, 0, 0, 6.4, 4.8, 0, 0};
  const CameraConstants adjust = constants_for(constants, 0);
  EXPECT_THAT(adjust.fake_chip_width, DoubleNear(6.4 * 720 / 700, 1e-14));
  EXPECT_THAT(adjust.fake_chip_height, DoubleNear(4.8, 1e-14));
  EXPECT_EQ(adjust.id, 7U);
  const CameraConstants keep = constants_for(adjust, wire::keep_aspect);
  EXPECT_THAT(keep.fake_chip_width, DoubleNear(6.4 * 720 / 700, 1e-14));
  EXPECT_THAT(keep.fake_chip_height, DoubleNear(4.8 * 720 / 700, 1e-14));
  // With the digits of an ASCII record.
  constants.fake_chip_width = 6.58286;
  constants.fake_chip_height = 4.8;
  EXPECT_EQ(constants_for(constants, 0), constants);
  EXPECT_NE(constants_for(constants, wire::keep_aspect), constants);
  const CameraConstants unusable{0, 0, 576, 10, 10, 0, 0, 6.4, 4.8, 1, 2};
  EXPECT_EQ(constants_for(unusable, wire::keep_aspect), unusable);
}

TEST(FakeChip, OfTheSenderIsUsedIfItIsPositive) {
  CameraParams params = matrix_params();
  params.format = wire::field_of_view | wire::ignore_blank;
  params.fov = 90;
  CameraConstants constants = valid_constants;
  constants.fake_chip_width = 20;
  constants.fake_chip_height = 15;
  EXPECT_NEAR(decode_lens(params, &constants)->image_distance, 10, 1e-12);
  constants.fake_chip_height = 0;
  EXPECT_NEAR(decode_lens(params, &constants)->image_distance, 9.59 * 720 / 704 / 2, 1e-12);
  params.format |= wire::vertical;
  EXPECT_NEAR(decode_lens(params, &constants)->image_distance, 7.19 * 576 / 574 / 2, 1e-12);
  params.format |= wire::keep_aspect;
  EXPECT_NEAR(decode_lens(params, &constants)->image_distance, 7.19 * 720 / 704 / 2, 1e-12);
}

TEST(Reasons, AllHaveDistinctTexts) {
  std::set<std::string> words;
  for (int i = 0; i <= static_cast<int>(CameraReason::bad_calibration); ++i) {
    EXPECT_TRUE(words.insert(describe(static_cast<CameraReason>(i))).second) << i;
  }
  EXPECT_EQ(words.count("unknown reason"), 0U);
}

}  // namespace trk_bridge::camera::camera_test
