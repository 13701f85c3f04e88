// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Which lens a CameraInfo describes.
#include "bridge/camera_info.h"

#include <cmath>

#include <gmock/gmock.h>

namespace trk_bridge::bridge::camera_info_test {

CameraInfo info_of(const std::string& model, std::vector<double> d) {
  CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.k = {1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1};
  info.distortion_model = model;
  info.d = std::move(d);
  return info;
}

/// 200 pixels per millimetre; the image size in it must be ignored.
wire::CameraConstants chip() { return {0, 720, 576, 0, 0, 0, 0, 9.6, 5.4, 9.6, 5.4}; }

void expect_fault(const CameraInfo& info, InfoReason reason) {
  const auto drawn = viewing_lens(info);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().reason, reason) << describe(drawn.error());
  const auto fitted = fit_lens(info, chip());
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error().reason, reason) << describe(fitted.error());
}

TEST(ViewingLens, ContainsTheValuesOfTheMessage) {
  const auto lens = viewing_lens(info_of("plumb_bob", {-0.1, 0.01, 1e-3, 2e-3, 0.5}));
  ASSERT_TRUE(lens);
  const camera::ViewingLens expected{
      {1500, 0, 959.5, 0, 1400, 539.5, 0, 0, 1}, {-0.1, 0.01, 1e-3, 2e-3, 0.5}, 1920, 1080};
  EXPECT_EQ(*lens, expected);
}

TEST(FittedLens, IsInMillimetresOfTheChip) {
  auto info = info_of("", {});
  info.k = {1600, 0, 999.5, 0, 1600, 519.5, 0, 0, 1};
  const auto fitted = fit_lens(info, chip());
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(fitted->lens.image_distance, 8, 1e-12);
  EXPECT_NEAR(fitted->lens.center_shift.x(), -0.2, 1e-12) << "40 pixels to the right of the middle";
  EXPECT_NEAR(fitted->lens.center_shift.y(), -0.1, 1e-12) << "20 pixels above it";
  EXPECT_EQ(fitted->lens.k1, 0);
}

TEST(CameraInfo, IsRefusedWithoutPixelsOrWithUnknownModels) {
  auto info = info_of("", {});
  info.height = 0;
  expect_fault(info, InfoReason::no_size);
  info.height = 0x80000000;
  expect_fault(info, InfoReason::no_size);
  // Four coefficients, but of a fisheye.
  expect_fault(info_of("equidistant", {0.1, 0, 0, 0}), InfoReason::unknown_model);
  expect_fault(info_of("equidistant", {}), InfoReason::unknown_model);
  expect_fault(info_of("", {0.1, 0, 0, 0}), InfoReason::unknown_model);
  expect_fault(info_of("plumb_bob", {0.1, 0, 0, 0, 0, 0, 0, 0}), InfoReason::coefficients);
  expect_fault(info_of("rational_polynomial", {0.1, 0, 0, 0, 0}), InfoReason::coefficients);
}

TEST(CameraInfo, FaultsNameWhatIsAllowed) {
  EXPECT_EQ(describe(InfoFault{InfoReason::no_size, {}}), "width and height must be from 1 to 2147483647");
  auto info = info_of("", {});
  info.width = info.height = 0x7fffffff;
  EXPECT_TRUE(viewing_lens(info));
  EXPECT_EQ(describe(InfoFault{InfoReason::coefficients, {}}),
            "D must have 0, 4 or 5 coefficients with plumb_bob, 8 with rational_polynomial");
  for (const std::size_t count : {0U, 4U, 5U}) {
    EXPECT_TRUE(viewing_lens(info_of("plumb_bob", std::vector<double>(count)))) << count;
    EXPECT_TRUE(fit_lens(info_of("plumb_bob", std::vector<double>(count)), chip())) << count;
  }
}

TEST(CameraInfo, InvalidNumbersAreExplained) {
  auto info = info_of("plumb_bob", {0, 0, 0, 0, 0});
  info.k[0] = 0;
  auto fitted = fit_lens(info, chip());
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error().reason, InfoReason::no_lens);
  EXPECT_EQ(describe(fitted.error()), camera::describe(camera::CameraReason::bad_calibration));
  info = info_of("plumb_bob", {0, std::nan(""), 0, 0, 0});
  fitted = fit_lens(info, chip());
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error().reason, InfoReason::no_lens);
}

TEST(CameraInfo, EveryNumberOfTheLensCountsForTheCalibration) {
  const auto info = info_of("plumb_bob", {0.1, 0, 0, 0, 0});
  EXPECT_TRUE(same_calibration(info, info));
  const auto expect_other = [&info](void (*change)(CameraInfo&)) {
    auto other = info;
    change(other);
    EXPECT_FALSE(same_calibration(info, other));
  };
  expect_other([](CameraInfo& i) { ++i.width; });
  expect_other([](CameraInfo& i) { ++i.height; });
  expect_other([](CameraInfo& i) { i.k[2] += 1; });
  expect_other([](CameraInfo& i) { i.d[4] = 1e-9; });
  expect_other([](CameraInfo& i) { i.distortion_model.clear(); });
}

}  // namespace trk_bridge::bridge::camera_info_test
