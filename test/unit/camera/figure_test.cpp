// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The drawing of a camera, compared with OpenCV's projection and the worked cases.
#include "camera/figure.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

#include "trk_bridge/camera/calibration.h"
#include "worked_cases.h"

namespace trk_bridge::camera::figure_test {

constexpr std::size_t edge = border_points_an_edge;
constexpr double degrees = 180 / M_PI;

std::vector<Eigen::Vector2d> opencv_pixels(const ViewingLens& lens, const std::vector<Eigen::Vector3d>& optical) {
  std::vector<cv::Point3d> points;
  for (const auto& point : optical) points.emplace_back(point.x(), point.y(), point.z());
  std::vector<cv::Point2d> projected;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), cv::Matx33d(lens.k.data()), lens.d, projected);
  std::vector<Eigen::Vector2d> pixels;
  for (const auto& pixel : projected) pixels.emplace_back(pixel.x, pixel.y);
  return pixels;
}

/// Goes around the image's outer edges, side by side.
std::vector<Eigen::Vector2d> border_pixels(const ViewingLens& lens) {
  const Eigen::Vector2d corners[] = {{0, 0}, {lens.width, 0}, {lens.width, lens.height}, {0, lens.height}, {0, 0}};
  std::vector<Eigen::Vector2d> pixels;
  for (int side = 0; side < 4; ++side) {
    for (std::size_t i = 0; i < edge; ++i) {
      const double fraction = static_cast<double>(i) / edge;
      pixels.push_back(corners[side] * (1 - fraction) + corners[side + 1] * fraction - Eigen::Vector2d(0.5, 0.5));
    }
  }
  return pixels;
}

double worst_pixel_error(const ViewingLens& lens, const ImageBorder& border) {
  const auto seen = opencv_pixels(lens, {border.bent.begin(), border.bent.end()});
  const auto wanted = border_pixels(lens);
  double worst = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) worst = std::max(worst, (seen[i] - wanted[i]).norm());
  return worst;
}

bool all_finite(const ImageBorder& border) {
  const auto finite = [](const Eigen::Vector3d& point) { return point.allFinite(); };
  return std::all_of(border.bent.begin(), border.bent.end(), finite) &&
         std::all_of(border.straight.begin(), border.straight.end(), finite) && std::isfinite(border.horizontal) &&
         std::isfinite(border.vertical) && std::isfinite(border.diagonal);
}

ViewingLens full_hd(double fx = 1500, double fy = 1500) {
  return {{fx, 0, 959.5, 0, fy, 539.5, 0, 0, 1}, {}, 1920, 1080};
}

class RandomLenses {
 public:
  ViewingLens next(std::size_t coefficients, double strength) {
    ViewingLens lens;
    lens.width = static_cast<std::uint32_t>(between(320, 4096));
    lens.height = static_cast<std::uint32_t>(between(240, 2160));
    const double fx = lens.width * between(0.6, 3);
    lens.k = {fx, 0, lens.width * between(0.4, 0.6), 0, fx * between(0.8, 1.25), lens.height * between(0.4, 0.6), 0,
              0,  1};
    const double radius = std::hypot(lens.width, lens.height) / 2 / fx;
    for (std::size_t i = 0; i < coefficients; ++i) {
      const bool is_tangential = i == 2 || i == 3;
      const double power = is_tangential ? 1 : i < 2 ? 2.0 * static_cast<double>(i + 1) : i == 5 ? 2 : i == 6 ? 4 : 6;
      lens.d.push_back(between(-strength, strength) * (is_tangential ? 0.1 : 1) / std::pow(radius, power));
    }
    return lens;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::mt19937_64 engine_{20040229};
};

TEST(ImageBorder, IsProjectedToTheEdgesOfTheImageByOpenCv) {
  RandomLenses random;
  for (const std::size_t coefficients : {0U, 4U, 5U, 8U}) {
    int drawn = 0;
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const ViewingLens lens = random.next(coefficients, 0.15);
      const auto border = image_border(lens);
      if (!border) {
        EXPECT_EQ(border.error(), CameraReason::not_monotonic) << describe(border.error());
        continue;
      }
      ++drawn;
      ASSERT_TRUE(all_finite(*border));
      worst = std::max(worst, worst_pixel_error(lens, *border));
    }
    EXPECT_LT(worst, 1e-6) << coefficients;
    EXPECT_GT(drawn, 250) << coefficients;
    RecordProperty("worst_pixels_" + std::to_string(coefficients), std::to_string(worst));
  }
}

TEST(ImageBorder, IsWhatTheLensesOfTheWorkedCasesSee) {
  for (const auto& c : test::worked_cases()) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(c.camera.lens, c.constants);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    const auto& d = calibration->distortion.d;
    const ViewingLens lens{c.k, {d.begin(), d.end()}, calibration->width, calibration->height};
    const auto border = image_border(lens);
    ASSERT_TRUE(border) << describe(border.error());
    EXPECT_LT(worst_pixel_error(lens, *border), 1e-6);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(border->corners[i], border->bent[i * edge]);
      const Eigen::Vector2d pinhole =
          (Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(c.k.data()) * border->straight[i])
              .hnormalized();
      EXPECT_LT((pinhole - border_pixels(lens)[i * edge]).norm(), 1e-9);
    }
  }
}

/// A lens whose image ends at a worked point has that point on its border: the inverse agrees with the case, as exactly
/// as D approximates the case's polynomial.
TEST(ImageBorder, HasThePointsOfTheWorkedCases) {
  constexpr double tolerance = 0.02;  // pixels
  int tested = 0;
  for (const auto& c : test::worked_cases()) {
    SCOPED_TRACE("mask " + std::to_string(c.mask));
    Calibrator calibrator;
    const auto calibration = calibrator.calibrate(c.camera.lens, c.constants);
    ASSERT_TRUE(calibration) << describe(calibration.error());
    const auto& d = calibration->distortion.d;
    for (const auto& point : c.points) {
      // The image moved so that its upper left corner is at the point, and one pixel large.
      ViewingLens lens{c.k, {d.begin(), d.end()}, 1, 1};
      lens.k[2] -= point.distorted.x() + 0.5;
      lens.k[5] -= point.distorted.y() + 0.5;
      const auto border = image_border(lens);
      ASSERT_TRUE(border) << describe(border.error());
      const Eigen::Vector3d wanted(point.camera.x() / point.camera.y(), -point.camera.z() / point.camera.y(), 1);
      EXPECT_LT((border->corners[0] - wanted).head<2>().norm() * c.k[0], 2 * tolerance);
      ++tested;
    }
  }
  EXPECT_GT(tested, 1000);
}

TEST(ImageBorder, GoesAroundFromTheUpperLeftCorner) {
  const auto border = image_border(full_hd());
  ASSERT_TRUE(border);
  const double right = 960 / 1500.0;
  const double down = 540 / 1500.0;
  const ImageBorder::Corners corners = {Eigen::Vector3d(-right, -down, 1), Eigen::Vector3d(right, -down, 1),
                                        Eigen::Vector3d(right, down, 1), Eigen::Vector3d(-right, down, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(border->corners[i].isApprox(corners[i], 1e-14)) << border->corners[i].transpose();
    EXPECT_TRUE(border->straight[i].isApprox(corners[i], 1e-14));
  }
}

TEST(ImageBorder, MeasuresItsAngles) {
  const auto border = image_border(full_hd(1500, 1400));
  ASSERT_TRUE(border);
  EXPECT_NEAR(border->horizontal, 2 * std::atan(960 / 1500.0) * degrees, 1e-12);
  EXPECT_NEAR(border->vertical, 2 * std::atan(540 / 1400.0) * degrees, 1e-12);
  EXPECT_NEAR(border->diagonal, 2 * std::atan(std::hypot(960 / 1500.0, 540 / 1400.0)) * degrees, 1e-12);
  const auto far = image_border(full_hd(1e9, 1e9));
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->horizontal, 1920e-9 * degrees, 1e-15);

  // Barrel distortion shows more than the pinhole would: the middle of the right edge is seen along r with
  // r (1 - 0.2 r^2) = 0.64.
  auto barrel = full_hd();
  barrel.d = {-0.2, 0, 0, 0, 0};
  const auto bent = image_border(barrel);
  ASSERT_TRUE(bent);
  const double r = std::tan(bent->horizontal / 2 / degrees);
  EXPECT_NEAR(r * (1 - 0.2 * r * r), 0.64, 1e-12);
  EXPECT_GT(bent->horizontal, border->horizontal);
}

TEST(ImageBorder, IsOffTheAxisWithCentreShiftAndBlanks) {
  // 1920 x 1080 on 9.6 x 5.4 mm are 200 pixels a mm; 40 blank pixels on the right leave 1880 of them on the chip.
  wire::CameraConstants constants{0, 1920, 1080, 0, 40, 0, 0, 9.4, 5.4, 0, 0};
  const Lens lens{10, {0.5, -0.25}, 0, 0, 0, 0};
  const ViewingLens viewing{camera_matrix(lens, constants), {}, 1920, 1080};
  const auto border = image_border(viewing);
  ASSERT_TRUE(border);
  // On the chip the image extends from -4.7 to 4.7 mm, plus 0.2 mm of blanks; the axis is at (+0.5, -0.25) from its
  // centre in the camera's axes, x right and y up: x' = x + cx.
  EXPECT_NEAR(border->corners[0].x(), (-4.7 + 0.5) / 10, 1e-12);
  EXPECT_NEAR(border->corners[2].x(), (4.7 + 0.2 + 0.5) / 10, 1e-12);
  EXPECT_NEAR(border->corners[0].y(), -(2.7 - 0.25) / 10, 1e-12);
  EXPECT_NEAR(border->corners[2].y(), -(-2.7 - 0.25) / 10, 1e-12);
}

void expect_refused(const ViewingLens& lens, CameraReason reason) {
  const auto border = image_border(lens);
  ASSERT_FALSE(border) << "fx " << lens.k[0];
  EXPECT_EQ(border.error(), reason) << describe(border.error());
}

TEST(ImageBorder, RefusesInvalidValues) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  expect_refused({}, CameraReason::bad_calibration);
  for (std::size_t i = 0; i < 9; ++i) {
    for (const double value : {nan, infinite, -infinite, -1.0}) {
      auto lens = full_hd();
      if (value == -1 && (i == 2 || i == 5)) continue;  // an optical axis beside the image is one
      lens.k[i] = value;
      expect_refused(lens, CameraReason::bad_calibration);
    }
  }
  auto skewed = full_hd();
  skewed.k[1] = 1e-3;
  expect_refused(skewed, CameraReason::bad_calibration);
  auto without_pixels = full_hd();
  without_pixels.width = 0;
  expect_refused(without_pixels, CameraReason::bad_calibration);
  without_pixels = full_hd();
  without_pixels.height = 0;
  expect_refused(without_pixels, CameraReason::bad_calibration);
  for (const std::size_t count : {1U, 2U, 3U, 6U, 7U, 9U, 12U, 14U}) {
    auto lens = full_hd();
    lens.d.assign(count, 0);
    expect_refused(lens, CameraReason::bad_calibration);
  }
  for (std::size_t i = 0; i < 8; ++i) {
    auto lens = full_hd();
    lens.d.assign(8, 0);
    lens.d[i] = nan;
    expect_refused(lens, CameraReason::bad_calibration);
  }
}

TEST(ImageBorder, RefusesImagesThatAreTooWideOrEmpty) {
  expect_refused(full_hd(10, 1500), CameraReason::too_wide);
  expect_refused(full_hd(1e-300, 1e-300), CameraReason::too_wide);
  expect_refused(full_hd(std::numeric_limits<double>::denorm_min(), 1), CameraReason::too_wide);
  auto beside = full_hd();
  beside.k[2] = 1e12;
  expect_refused(beside, CameraReason::too_wide);
  // Wide only because of the distortion: D is nearly r / 8 there, and without D the corner is 82 degrees off the axis.
  auto bent = full_hd(147, 147);
  EXPECT_TRUE(image_border(bent));
  bent.d = {0.125, 0, 0, 0, 0, 1, 0, 0};
  expect_refused(bent, CameraReason::too_wide);
  // The pixels vanish beside the centre: nothing is left between the edges.
  auto lost = full_hd(1e20, 1e20);
  lost.k[2] = lost.k[5] = 1e20;
  expect_refused(lost, CameraReason::bad_calibration);
  EXPECT_TRUE(image_border(full_hd(1e100, 1e100)));
}

TEST(ImageBorder, RefusesLensesThatFoldTheImage) {
  auto radial = full_hd();
  radial.d = {-0.5, 0, 0, 0, 0};  // turns back at r = 0.816, distorted 0.54; the corner is at 0.73
  expect_refused(radial, CameraReason::not_monotonic);
  auto pole = full_hd();
  pole.d = {0, 0, 0, 0, 0, -4, 0, 0};  // r / (1 - 4 r^2): increasing to infinity, reached 0.73 before
  EXPECT_TRUE(image_border(pole));
  // The left edge is where p2 folds the plane: x + 3 p2 x^2 turns back at x = -1 / (6 p2), distorted -1 / (12 p2).
  auto tangential = full_hd();
  tangential.d = {0, 0, 0, 1 / (12 * 0.63), 0};
  expect_refused(tangential, CameraReason::not_monotonic);
  tangential.d[3] = 1 / (12 * 1.2);
  const auto border = image_border(tangential);
  ASSERT_TRUE(border);
  EXPECT_LT(worst_pixel_error(tangential, *border), 1e-6);
}

TEST(ImageBorder, RefusesOnlyLensesThatOpenCvFoldsAsWell) {
  RandomLenses random;
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    ViewingLens lens = random.next(8, 0.2);
    lens.d[2] = lens.d[3] = 0;
    if (image_border(lens)) continue;
    ++refused;
    double reach = 0;
    for (const auto& pixel : border_pixels(lens)) {
      reach = std::max(reach, std::hypot((pixel.x() - lens.k[2]) / lens.k[0], (pixel.y() - lens.k[5]) / lens.k[4]));
    }
    std::vector<Eigen::Vector3d> outward;
    for (int step = 0; step <= 100000; ++step) outward.emplace_back(reach * step / 2000, 0, 1);
    const auto seen = opencv_pixels(lens, outward);
    const double edge_of_reach = lens.k[2] + reach * lens.k[0];
    std::size_t rising = 1;
    while (rising < seen.size() && seen[rising].x() > seen[rising - 1].x() && seen[rising].x() < edge_of_reach)
      ++rising;
    // Never reached, turned back before it, or moved beyond it by a pole.
    EXPECT_TRUE(rising == seen.size() || seen[rising].x() < edge_of_reach || seen[rising].x() > 10 * edge_of_reach)
        << "OpenCV reaches it at " << outward[std::min(rising, seen.size() - 1)].x() << ", reach " << reach;
  }
  EXPECT_GT(refused, 20);
}

TEST(ImageBorder, IsNeverNaN) {
  std::mt19937_64 engine(19980901);
  std::uniform_int_distribution<int> exponent(-320, 308);
  std::uniform_int_distribution<int> sign(0, 1);
  const auto absurd = [&] { return (sign(engine) ? 1 : -1) * std::pow(10.0, exponent(engine)); };
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    ViewingLens lens{{std::abs(absurd()), 0, absurd(), 0, std::abs(absurd()), absurd(), 0, 0, 1},
                     {absurd(), absurd(), absurd(), absurd(), absurd()},
                     1920,
                     1080};
    if (i % 2 == 0) lens.k = full_hd().k;
    if (i % 3 == 0) lens.d.resize(8, absurd());
    const auto border = image_border(lens);
    EXPECT_TRUE(!border || all_finite(*border));
    refused += border ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
}

TEST(Frustum, JoinsTheBorderNearAndFar) {
  auto lens = full_hd();
  lens.d = {-0.1, 0.02, 1e-3, -2e-3, 0};
  const auto border = image_border(lens);
  ASSERT_TRUE(border);
  const auto lines = frustum_lines(*border, 0.5, 4);
  ASSERT_EQ(lines.size(), 2 * (2 * 4 * edge + 4));
  for (std::size_t i = 0; i < 4 * edge; ++i) {
    EXPECT_EQ(lines[2 * i], border->bent[i] * 0.5);
    EXPECT_EQ(lines[2 * i + 1], lines[2 * ((i + 1) % (4 * edge))]) << "the outline is closed";
    EXPECT_EQ(lines[8 * edge + 2 * i], border->bent[i] * 4.0);
    EXPECT_EQ(lines[8 * edge + 2 * i + 1], lines[8 * edge + 2 * ((i + 1) % (4 * edge))]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(lines[16 * edge + 2 * i], border->corners[i] * 0.5);
    EXPECT_EQ(lines[16 * edge + 2 * i + 1], border->corners[i] * 4.0);
  }
}

TEST(Outline, IsClosedAtItsDepth) {
  const auto border = image_border(full_hd());
  ASSERT_TRUE(border);
  const auto outline = outline_at(*border, 2.5);
  ASSERT_EQ(outline.size(), 4 * edge + 1);
  EXPECT_EQ(outline.front(), outline.back());
  for (std::size_t i = 0; i < 4 * edge; ++i) EXPECT_EQ(outline[i], border->bent[i] * 2.5);
}

/// Twice the signed area, x right and y down: positive clockwise as the camera sees it.
double doubled_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
}

TEST(Area, IsFilledWithoutOverlap) {
  auto bent = full_hd(900, 900);
  bent.d = {0.6, 0.3, 0, 0, 0};  // pincushion: the edges of what it shows are bent inwards
  auto off_axis = full_hd();
  off_axis.k[2] = -400;  // the axis is outside of the image
  for (const auto& lens : {full_hd(), bent, off_axis}) {
    const auto border = image_border(lens);
    ASSERT_TRUE(border);
    const double depth = 3;
    const auto triangles = area_at(*border, depth);
    ASSERT_EQ(triangles.size(), 3 * 4 * edge);
    double filled = 0;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const double area = doubled_area(triangles[i], triangles[i + 1], triangles[i + 2]);
      EXPECT_GT(area, 0) << "triangle " << i / 3 << " is turned over";
      filled += area;
      EXPECT_DOUBLE_EQ(triangles[i].z(), depth);
    }
    // The polygon's own area, by the shoelace formula.
    double wanted = 0;
    const auto outline = outline_at(*border, depth);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      wanted += outline[i].x() * outline[i + 1].y() - outline[i + 1].x() * outline[i].y();
    }
    EXPECT_NEAR(filled, wanted, 1e-9 * wanted);
  }
}

TEST(ViewingLens, ComparesAllNumbers) {
  const auto lens = full_hd();
  EXPECT_EQ(lens, full_hd());
  auto other = lens;
  other.k[0] += 1e-9;
  EXPECT_NE(lens, other);
  other = lens;
  other.d = {0, 0, 0, 0};
  EXPECT_NE(lens, other);
  other = lens;
  other.width = 1;
  EXPECT_NE(lens, other);
  other = lens;
  other.height = 1;
  EXPECT_NE(lens, other);
}

}  // namespace trk_bridge::camera::figure_test
