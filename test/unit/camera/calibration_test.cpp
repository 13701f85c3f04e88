// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/calibration.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "trk_bridge/camera/image.h"

namespace trk_bridge::camera::calibration_test {

using ::testing::Each;
using ::testing::ElementsAre;
using wire::CameraConstants;

const CameraConstants hd{0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 0, 0};
const double corner = std::hypot(9.59, 5.39) / 2;

/// A lens with u = `at_corner` in the corner of the picture, of which `share` comes from k1.
Lens lens_with(double at_corner, double share) {
  const double squared = corner * corner;
  const double excess = at_corner - 1;
  return Lens{8, {0, 0}, excess * share / squared, excess * (1 - share) / (squared * squared), 0, 0};
}

/// OpenCV's radial distortion, from its documentation.
double opencv_factor(const Distortion& distortion, double q) {
  const auto& d = distortion.d;
  const double s = q * q;
  const double polynomial = 1 + d[0] * s + d[1] * s * s + d[4] * s * s * s;
  return distortion.model == DistortionModel::plumb_bob ? polynomial
                                                        : polynomial / (1 + d[5] * s + d[6] * s * s + d[7] * s * s * s);
}

/// The largest difference between the points of K and D and those of the lens, in units of the longer side of a pixel.
double measured_residual(const Lens& lens, const CameraConstants& constants, const Distortion& distortion) {
  const Raster raster = raster_of(constants);
  const double reach = image_reach(lens, raster);
  double worst = 0;
  for (int i = 1; i <= 2000; ++i) {
    const double r = reach * i / 2000;
    const double undistorted = undistort(lens, Eigen::Vector2d(r, 0) - lens.center_shift).x() + lens.center_shift.x();
    const double distorted = undistorted * opencv_factor(distortion, undistorted / lens.image_distance);
    worst = std::max(worst, std::abs(distorted - r) * std::max(raster.mx, raster.my));
  }
  return worst;
}

TEST(Calibrator, IsAsExactAsTheModelsCanBe) {
  struct Row {
    double at_corner, share;
    DistortionModel model;
    double residual;
  };
  const Row rows[] = {{1.003, 0.5, DistortionModel::plumb_bob, 0.0005},
                      {1.041, 0.3, DistortionModel::plumb_bob, 0.0065},
                      {0.925, 0.92, DistortionModel::rational_polynomial, 0.0001},
                      {1.257, 0.5, DistortionModel::rational_polynomial, 0.00025},
                      {0.843, 0.85, DistortionModel::rational_polynomial, 0.00025}};
  for (const auto& row : rows) {
    SCOPED_TRACE(row.at_corner);
    const Lens lens = lens_with(row.at_corner, row.share);
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(lens, hd);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    const Distortion& distortion = calibration->distortion;
    EXPECT_EQ(distortion.model, row.model);
    EXPECT_LE(distortion.residual, row.residual);
    EXPECT_NEAR(distortion.residual, measured_residual(lens, hd, distortion), 0.02 * distortion.residual + 1e-9);
    EXPECT_EQ(distortion.d[2], 0);
    EXPECT_EQ(distortion.d[3], 0);
  }
}

TEST(Calibrator, PlumbBobAlwaysIsAsExactAsPlumbBobCanBe) {
  // The values of lens_fit.md.
  for (const auto& [at_corner, share, residual] : {std::tuple{0.925, 0.92, 0.035}, {1.257, 0.5, 0.724}}) {
    SCOPED_TRACE(at_corner);
    const Lens lens = lens_with(at_corner, share);
    Calibrator calibrator(std::numeric_limits<double>::infinity());
    const auto calibration = calibrator.calibrate(lens, hd);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    const Distortion& distortion = calibration->distortion;
    EXPECT_EQ(distortion.model, DistortionModel::plumb_bob);
    EXPECT_NEAR(distortion.residual, residual, 0.05 * residual);
    EXPECT_NEAR(distortion.residual, measured_residual(lens, hd, distortion), 0.02 * distortion.residual);
  }
}

TEST(Calibrator, KeepsPointsJustOutsideOutside) {
  for (double share = 0.5; share <= 1; share += 0.02) {
    const Lens lens = lens_with(0.925, share);
    ASSERT_GT(monotonic_radius(lens), 1.2 * corner);
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(lens, hd);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    for (double r = corner; r < 1.2 * corner; r += 0.01) {
      const double undistorted = undistort(lens, {r, 0}).x();
      const double distorted = undistorted * opencv_factor(calibration->distortion, undistorted / lens.image_distance);
      EXPECT_NEAR(distorted, r, 0.03 * r) << "share " << share;
    }
  }
}

TEST(Calibrator, FitsEveryLensThatDoesNotFold) {
  for (double at_corner = 0.8; at_corner < 1.35; at_corner += 0.01) {
    for (double share = -1; share <= 3; share += 0.1) {
      SCOPED_TRACE(std::to_string(at_corner) + " " + std::to_string(share));
      const Lens lens = lens_with(at_corner, share);
      Calibrator calibrator;
      const auto calibration = calibrator.calibrate(lens, hd);
      if (monotonic_radius(lens) < corner) {
        ASSERT_FALSE(calibration);
        EXPECT_EQ(calibration.error(), CameraReason::not_monotonic);
        continue;
      }
      ASSERT_TRUE(calibration) << describe(calibration.error());
      const Distortion& distortion = calibration->distortion;
      EXPECT_LE(measured_residual(lens, hd, distortion), 1.05 * distortion.residual + 1e-9);
      // Near its fold a lens bends like a square root, which neither model can represent.
      if (monotonic_radius(lens) > 1.3 * corner && share >= 0 && share <= 2) {
        EXPECT_LE(distortion.residual, 0.02);
      }
    }
  }
}

TEST(Calibrator, FitsNothingWithoutDistortion) {
  Calibrator calibrator;
  const auto calibration = calibrator.calibrate(Lens{8, {0.1, 0.2}}, hd);
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->distortion.model, DistortionModel::plumb_bob);
  EXPECT_THAT(calibration->distortion.d, Each(0.0));
  EXPECT_EQ(calibration->distortion.residual, 0);
}

TEST(Calibrator, GivesKInPixelsFromTheCentreOfTheFirst) {
  Calibrator calibrator;
  // 4:3 chip in 720 x 576, the axis 1 mm right of the chip's centre and 0.5 mm above.
  const auto calibration = calibrator.calibrate(Lens{10, {-1, -0.5}}, {0, 720, 576, 8, 12, 4, 2, 7, 5.7, 0, 0});
  ASSERT_TRUE(calibration);
  const auto& k = calibration->k;
  EXPECT_NEAR(k[0], 1000, 1e-9);
  EXPECT_NEAR(k[4], 1000, 1e-9);
  EXPECT_NEAR(k[2], 8 + 350 + 100 - 0.5, 1e-9);
  EXPECT_NEAR(k[5], 4 + 285 - 50 - 0.5, 1e-9);
  EXPECT_EQ(k[1], 0);
  EXPECT_EQ(k[8], 1);
  EXPECT_EQ(calibration->width, 720U);
  EXPECT_EQ(calibration->height, 576U);
}

TEST(Calibrator, FitsOnlyWhenTheLensChanges) {
  Calibrator calibrator;
  Lens lens = lens_with(0.925, 0.7);
  ASSERT_TRUE(calibrator.calibrate(lens, hd));
  EXPECT_EQ(calibrator.fits(), 1U);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(calibrator.calibrate(lens, hd));
  EXPECT_EQ(calibrator.fits(), 1U) << "a camera that only moves";
  lens.focdist = 7;
  lens.image_distance *= 1.5;
  const auto zoomed = calibrator.calibrate(lens, hd);
  ASSERT_TRUE(zoomed);
  EXPECT_EQ(calibrator.fits(), 1U) << "a zoom at the same k1 and k2 only scales";
  EXPECT_NEAR(measured_residual(lens, hd, zoomed->distortion), zoomed->distortion.residual, 1e-6);
  lens.k1 *= 1.01;
  ASSERT_TRUE(calibrator.calibrate(lens, hd));
  EXPECT_EQ(calibrator.fits(), 2U);
  lens.k2 *= 1.01;
  ASSERT_TRUE(calibrator.calibrate(lens, hd));
  EXPECT_EQ(calibrator.fits(), 3U);
  lens.center_shift.x() = 0.1;
  ASSERT_TRUE(calibrator.calibrate(lens, hd));
  EXPECT_EQ(calibrator.fits(), 4U) << "the image reaches farther";
  CameraConstants fewer_pixels = hd;
  fewer_pixels.image_width /= 2;
  fewer_pixels.image_height /= 2;
  ASSERT_TRUE(calibrator.calibrate(lens, fewer_pixels));
  EXPECT_EQ(calibrator.fits(), 5U) << "half the pixels, half the residual";
}

TEST(Calibrator, RecoversAfterALensThatFolds) {
  Calibrator calibrator;
  const Lens good = lens_with(0.95, 0.7);
  const auto before = calibrator.calibrate(good, hd);
  ASSERT_TRUE(before);
  const auto folded = calibrator.calibrate(lens_with(0.5, 0.0), hd);
  ASSERT_FALSE(folded);
  EXPECT_EQ(folded.error(), CameraReason::not_monotonic);
  const auto after = calibrator.calibrate(good, hd);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->distortion.d, before->distortion.d);
}

TEST(Calibrator, RefusesInvalidLenses) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto reason = [](const Lens& lens, const CameraConstants& constants) {
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(lens, constants);
    EXPECT_FALSE(calibration);
    return calibration ? CameraReason{} : calibration.error();
  };
  EXPECT_EQ(reason(Lens{0}, hd), CameraReason::bad_field_of_view);
  EXPECT_EQ(reason(Lens{-8}, hd), CameraReason::bad_field_of_view);
  auto wide = hd;
  wide.chip_width = wide.fake_chip_width = wide.chip_height = wide.fake_chip_height = 1e10;
  EXPECT_EQ(reason(Lens{std::numeric_limits<double>::denorm_min()}, wide), CameraReason::bad_field_of_view)
      << "a focal length of 0 pixels";
  EXPECT_EQ(reason(Lens{nan}, hd), CameraReason::not_finite);
  EXPECT_EQ(reason(Lens{8, {nan, 0}}, hd), CameraReason::not_finite);
  EXPECT_EQ(reason(Lens{8, {0, 0}, nan, 0}, hd), CameraReason::not_finite);
  EXPECT_EQ(reason(Lens{8, {0, 0}, 0, nan}, hd), CameraReason::not_finite);
  EXPECT_EQ(reason(Lens{8, {0, 0}, 1e300, 1e300}, hd), CameraReason::no_fit);
  EXPECT_EQ(reason(Lens{1e300, {0, 0}, 1e-3, 0}, hd), CameraReason::no_fit);
  CameraConstants no_picture = hd;
  no_picture.blank_top = 1080;
  EXPECT_EQ(reason(Lens{8}, no_picture), CameraReason::bad_constants);
}

TEST(DistortionModels, HaveTheNamesOfSensorMsgs) {
  EXPECT_STREQ(name(DistortionModel::plumb_bob), "plumb_bob");
  EXPECT_STREQ(name(DistortionModel::rational_polynomial), "rational_polynomial");
}

std::vector<double> published(const Distortion& distortion) {
  return {distortion.d.begin(), distortion.d.begin() + (distortion.model == DistortionModel::plumb_bob ? 5 : 8)};
}

TEST(FitLens, GivesBackTheLensThatWasPublished) {
  CameraConstants constants{0, 720, 576, 8, 12, 4, 2, 9.59, 7.19, 0, 0};
  for (const double k1 : {0.0, 1e-4, -1e-3, 3e-3}) {
    for (const double k2 : {0.0, 1e-5, -2e-5}) {
      SCOPED_TRACE(std::to_string(k1) + " " + std::to_string(k2 * 1e5) + "e-5");
      const Lens lens{7.3, {0.2, -0.1}, k1, k2, 0, 0};
      Calibrator calibrator;
      const auto calibration = calibrator.calibrate(lens, constants);
      ASSERT_TRUE(calibration) << describe(calibration.error());
      const auto back = fit_lens(calibration->k, published(calibration->distortion), constants);
      ASSERT_TRUE(back) << describe(back.error());
      EXPECT_NEAR(back->lens.image_distance, lens.image_distance, 1e-9);
      EXPECT_LE((back->lens.center_shift - lens.center_shift).norm(), 1e-9);
      EXPECT_LE(back->residual, 0.02);
      EXPECT_EQ(back->tangential, 0);
      EXPECT_NEAR(back->aspect, 0, 1e-9);
      EXPECT_EQ(back->lens.focdist, 0);
      const auto k = camera_matrix(back->lens, constants);
      for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(k[i], calibration->k[i], 1e-9 * std::max(1.0, std::abs(k[i])));
      const Raster raster = raster_of(constants);
      for (const double u : {-0.5, 200.0, 719.5}) {
        for (const double v : {-0.5, 300.0, 575.5}) {
          const Eigen::Vector2d chip = undistort(lens, to_chip(raster, {u, v}));
          const auto again = distort(back->lens, chip);
          ASSERT_TRUE(again);
          EXPECT_LE((to_pixel(raster, *again) - Eigen::Vector2d(u, v)).norm(), 0.02);
        }
      }
    }
  }
}

TEST(FitLens, ReadsEveryLengthOfD) {
  const std::array<double, 9> k = {1600, 0, 959.5, 0, 1600 * (1080 / 5.39) / (1920 / 9.59), 539.5, 0, 0, 1};
  const auto none = fit_lens(k, {}, hd);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->lens.k1, 0);
  EXPECT_EQ(none->lens.k2, 0);
  EXPECT_EQ(none->residual, 0);
  EXPECT_NEAR(none->lens.image_distance, 1600 * 9.59 / 1920, 1e-12);
  EXPECT_LE(none->lens.center_shift.norm(), 1e-12);
  const auto four = fit_lens(k, {-0.1, 0.02, 0, 0}, hd);
  const auto five = fit_lens(k, {-0.1, 0.02, 0, 0, 0}, hd);
  const auto eight = fit_lens(k, {-0.1, 0.02, 0, 0, 0, 0, 0, 0}, hd);
  ASSERT_TRUE(four && five && eight);
  EXPECT_GT(four->lens.k1, 0) << "barrel one way is pincushion the other";
  EXPECT_EQ(four->lens.k1, five->lens.k1);
  EXPECT_EQ(four->lens.k2, eight->lens.k2);
  EXPECT_LE(four->residual, 0.3);
}

TEST(FitLens, ReportsItsTrueResidual) {
  const std::array<double, 9> k = {1600, 0, 959.5, 0, 1600 * (1080 / 5.39) / (1920 / 9.59), 539.5, 0, 0, 1};
  const Distortion distortion{DistortionModel::rational_polynomial, {-0.3, 0.1, 0, 0, -0.02, 0.05, -0.01, 0.003}, 0};
  const auto fitted = fit_lens(k, published(distortion), hd);
  ASSERT_TRUE(fitted) << describe(fitted.error());
  EXPECT_GT(fitted->residual, 1e-3);
  EXPECT_NEAR(measured_residual(fitted->lens, hd, distortion), fitted->residual, 0.1 * fitted->residual);
}

TEST(FitLens, ReportsHowMuchIsLost) {
  // Without radial terms p2 moves a point in the corner by 3 p2 x^2 + p2 y^2 across and 2 p2 xy down.
  const std::array<double, 9> k = {1000, 0, 499.5, 0, 1000, 499.5, 0, 0, 1};
  const CameraConstants square{0, 1000, 1000, 0, 0, 0, 0, 10, 10, 0, 0};
  const auto tangential = fit_lens(k, {0, 0, 0, 1e-3, 0}, square);
  ASSERT_TRUE(tangential);
  EXPECT_NEAR(tangential->tangential, 1000 * 1e-3 * std::hypot(4 * 0.25, 2 * 0.25), 1e-9);
  // fy two percent more than the chip's height gives: the uppermost row is off by two percent of its distance.
  const auto aspect = fit_lens({1000, 0, 499.5, 0, 1000 / 0.98, 499.5, 0, 0, 1}, {}, square);
  ASSERT_TRUE(aspect);
  EXPECT_NEAR(aspect->aspect, 0.02 * 500, 1e-9);
  EXPECT_EQ(aspect->lens.image_distance, 10);
}

TEST(FitLens, AResidualThatIsNotFiniteIsRefused) {
  auto tiny_chip = hd;
  tiny_chip.chip_width = tiny_chip.chip_height = 1e-290;
  Lens far_off;
  far_off.image_distance = 8;
  far_off.center_shift = {5e54, 5e54};
  const auto fitted = fit_lens(far_off, {{1e10, 0, 0}, {}}, tiny_chip);
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error(), CameraReason::not_finite);
}

TEST(FitLens, OfAnUndistortion) {
  const Lens lens = lens_with(1.05, 0.7);
  Lens bare = lens;
  bare.k1 = bare.k2 = 0;
  bare.center_shift = {0.3, -0.2};
  const auto same = fit_lens(bare, {{lens.k1, lens.k2, 0}, {}}, hd);
  ASSERT_TRUE(same);
  EXPECT_NEAR(same->lens.k1, lens.k1, 1e-12);
  EXPECT_NEAR(same->lens.k2, lens.k2, 1e-13);
  EXPECT_EQ(same->lens.center_shift, bare.center_shift);
  EXPECT_LE(same->residual, 1e-9);
  // The error of k1 and k2 is reported in pixels: measured here along a radius.
  const Undistortion ratio{{4e-3, 0, 0}, {1e-2, 0, 0}};
  bare.center_shift.setZero();
  const auto near = fit_lens(bare, ratio, hd);
  ASSERT_TRUE(near);
  double worst = 0;
  for (int i = 1; i <= 500; ++i) {
    const double r = corner * i / 500, s = r * r;
    const double undistorted = r * (1 + 4e-3 * s) / (1 + 1e-2 * s);
    const auto chip = distort(near->lens, {undistorted, 0});
    ASSERT_TRUE(chip);
    worst = std::max(worst, std::abs(chip->x() - r) * 1080 / 5.39);
  }
  EXPECT_NEAR(near->residual, worst, 0.02 * worst);
  EXPECT_GT(worst, 0.01);

  const auto reason = [&](const Undistortion& distortion, const Lens& of, const CameraConstants& constants) {
    const auto fitted = fit_lens(of, distortion, constants);
    EXPECT_FALSE(fitted);
    return fitted ? CameraReason{} : fitted.error();
  };
  EXPECT_EQ(reason({{-0.1, 0, 0}, {}}, bare, hd), CameraReason::not_monotonic) << "folds within the image";
  EXPECT_EQ(reason({{}, {-0.1, 0, 0}}, bare, hd), CameraReason::not_monotonic) << "a pole in the image";
  EXPECT_EQ(reason({}, bare, {}), CameraReason::bad_constants);
  EXPECT_EQ(reason({}, Lens{}, hd), CameraReason::bad_field_of_view);
}

TEST(FitLens, RefusesInvalidCameraInfo) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 9> good = {1600, 0, 959.5, 0, 1600, 539.5, 0, 0, 1};
  const auto reason = [](const std::array<double, 9>& k, const std::vector<double>& d, const CameraConstants& c) {
    const auto fitted = fit_lens(k, d, c);
    EXPECT_FALSE(fitted);
    return fitted ? CameraReason{} : fitted.error();
  };
  EXPECT_EQ(reason(std::array<double, 9>{}, {}, hd), CameraReason::bad_calibration) << "an uncalibrated camera";
  const std::pair<std::size_t, double> wrong[] = {{0, -1}, {0, nan}, {4, 0}, {2, nan}, {1, 3}, {8, 0}, {6, 1}};
  for (const auto& [element, value] : wrong) {
    auto k = good;
    k[element] = value;
    EXPECT_EQ(reason(k, {}, hd), CameraReason::bad_calibration) << "K element " << element;
  }
  for (const std::size_t size : {1U, 2U, 3U, 6U, 7U, 12U, 14U}) {
    EXPECT_EQ(reason(good, std::vector<double>(size, 0.0), hd), CameraReason::bad_calibration) << size;
  }
  EXPECT_EQ(reason(good, {0, 0, nan, 0, 0}, hd), CameraReason::bad_calibration);
  EXPECT_EQ(reason(good, {-3, 0, 0, 0, 0}, hd), CameraReason::not_monotonic) << "folds within the image";
  EXPECT_EQ(reason(good, {0, 0, 0, 0, 0, -20, 0, 0}, hd), CameraReason::not_monotonic) << "a pole in the image";
  EXPECT_EQ(reason(good, {}, {}), CameraReason::bad_constants);
}

}  // namespace trk_bridge::camera::calibration_test
