// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The visible part of the card: everything in front of the camera that its lens maps into the picture, and nothing
// else.
#include "demo/test_card_view.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "../camera/random_cameras.h"
#include "demo/test_card_picture.h"

namespace trk_bridge::demo::test_card_view_test {

wire::CameraConstants hd() {
  wire::CameraConstants constants;
  constants.image_width = 1920;
  constants.image_height = 1080;
  constants.chip_width = 9.6;
  constants.chip_height = 5.4;
  return constants;
}

/// At the origin of the studio, 1.5 m above the floor, looking into it.
wire::CameraParams level_camera() {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler.z = 1.5;
  params.fov = 9.6;
  return params;
}

TEST(TestCardView, SeesTheMiddleOfTheCardInTheMiddle) {
  const auto view = View::of(level_camera(), hd());
  ASSERT_TRUE(view);
  EXPECT_EQ(view->width(), 1920);
  EXPECT_EQ(view->height(), 1080);
  // At 12 m and an image distance of 9.6 mm a metre is 160 pixels.
  const auto ahead = view->see(Eigen::Vector3d(0, 12, 1.5)), aside = view->see(Eigen::Vector3d(3, 12, 0.5));
  ASSERT_TRUE(ahead && aside);
  EXPECT_LT((*ahead - Eigen::Vector2d(959.5, 539.5)).norm(), 1e-9);
  EXPECT_LT((*aside - Eigen::Vector2d(959.5 + 480, 539.5 + 160)).norm(), 1e-9);
}

TEST(TestCardView, DoesNotSeePointsBehindOrInvalidOnes) {
  const auto view = View::of(level_camera(), hd());
  ASSERT_TRUE(view);
  Polyline seen;
  EXPECT_FALSE(view->see(Eigen::Vector3d(0, -1, 1.5)));
  EXPECT_FALSE(view->see(Eigen::Vector3d(0, 0, 1.5)));
  view->see({{-5, -1, 0}, {5, -1, 0}}, seen);
  EXPECT_THAT(seen, ::testing::IsEmpty());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(view->see(Eigen::Vector3d(nan, 5, 1)));
  EXPECT_FALSE(view->see(Eigen::Vector3d(0, nan, 1)));
  view->see({{nan, 5, 0}, {5, 5, 0}}, seen);
  EXPECT_THAT(seen, ::testing::IsEmpty());
}

TEST(TestCardView, ALineFromBehindIsClippedToThePicture) {
  const auto view = View::of(level_camera(), hd());
  ASSERT_TRUE(view);
  Polyline seen;
  view->see({{0, -10, 0}, {0, 12, 0}}, seen);
  ASSERT_GE(seen.size(), 2u);
  const double lowest = std::max(seen.front().y(), seen.back().y());
  const double highest = std::min(seen.front().y(), seen.back().y());
  EXPECT_GT(lowest, 1080) << "over the lower edge";
  EXPECT_LT(lowest, 2000) << "but not for ever";
  EXPECT_NEAR(highest, 539.5 + 240, 1e-9) << "the foot of the wall";
}

TEST(TestCardView, ALensThatFoldsShowsWhatIsWithinTheFold) {
  auto params = level_camera();
  params.k1 = -0.03;  // folds at 3.33 mm of the 5.5 mm to the corner
  const auto view = View::of(params, hd());
  ASSERT_TRUE(view);
  Polyline seen;
  for (const Line& line : figure_at({}).wall) {
    view->see(line, seen);
    for (const auto& pixel : seen) EXPECT_LE((pixel - Eigen::Vector2d(959.5, 539.5)).norm(), 3.34 * 200);
  }
  view->see({{-8, 12, 1.5}, {8, 12, 1.5}}, seen);
  ASSERT_GE(seen.size(), 2u);
  EXPECT_GT((seen.back() - seen.front()).norm(), 2 * 3.2 * 200) << "almost to it";
}

TEST(TestCardView, SaysWhyThereIsNoPicture) {
  auto constants = hd();
  constants.chip_width = 0;
  EXPECT_EQ(View::of(level_camera(), constants).error(), camera::CameraReason::bad_constants);
  auto params = level_camera();
  params.fov = 0;
  EXPECT_EQ(View::of(params, hd()).error(), camera::CameraReason::bad_field_of_view);
  params.fov = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(View::of(params, hd()));
}

TEST(TestCardView, AnyCameraAndAnyLensMakesAPicture) {
  test::RandomCameras random;
  const Figure figure = figure_at({});
  Polyline seen;
  std::size_t most = 0;
  for (int i = 0; i < 200; ++i) {
    auto camera = random.camera();
    auto constants = random.constants();
    constants.image_width /= 4;
    constants.image_height /= 4;
    constants.blank_left = constants.blank_right = constants.blank_top = constants.blank_bottom = 0;
    // From harmless to absurd values.
    const double absurd = std::pow(10.0, i % 10 - 1);
    camera.lens.k1 *= absurd;
    camera.lens.k2 *= absurd;
    camera.lens.center_shift *= absurd;
    const auto params = camera::encode(camera, wire::euler, &constants);
    ASSERT_TRUE(params);
    const auto view = View::of(*params, constants);
    ASSERT_TRUE(view) << camera::describe(view.error());
    cv::Mat picture(view->height(), view->width(), CV_8UC1);
    draw(figure, *view, picture);
    for (const Line& line : figure.floor) {
      view->see(line, seen);
      most = std::max(most, seen.size());
      for (const auto& pixel : seen) ASSERT_TRUE(pixel.allFinite());
    }
  }
  EXPECT_LT(most, 5000u) << "corners of a line";
}

TEST(TestCardFigure, HasWholeCellsAndTheCoordinatesOfItsLabels) {
  Place place;
  place.x = 1;
  place.y = 10;
  place.width = 4.5;
  place.depth = 3;
  place.height = 2;
  const Figure figure = figure_at(place);
  EXPECT_EQ(figure.floor.size(), 5u + 4u);
  EXPECT_EQ(figure.wall.size(), 5u + 2u) << "its foot is a line of the floor";
  EXPECT_EQ(figure.points.size(), 5u * 4u + 5u * 2u);
  for (const Point& point : figure.points) {
    EXPECT_GE(point.place.x(), -1);
    EXPECT_LE(point.place.x(), 3);
    EXPECT_TRUE(point.place.z() == 0 || point.place.y() == 10) << "on the floor or on the wall";
  }
  const auto labelled = std::find_if(figure.points.begin(), figure.points.end(),
                                     [](const Point& point) { return point.label == "1 10 2"; });
  ASSERT_NE(labelled, figure.points.end());
  EXPECT_EQ(labelled->place, Eigen::Vector3d(1, 10, 2));
}

TEST(TestCardFigure, WallOrFloorMayBeOmitted) {
  Place place;
  place.height = 0;
  EXPECT_THAT(figure_at(place).points, ::testing::Each(::testing::Field(
                                           &Point::place, ::testing::Truly([](const auto& p) { return p.z() == 0; }))));
  place.width = 0.3;
  EXPECT_EQ(figure_at(place).points.size(), 13u) << "one line that goes into the studio";
}

}  // namespace trk_bridge::demo::test_card_view_test
