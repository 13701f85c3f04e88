// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "lens/table.h"

#include <gmock/gmock.h>

#include <cmath>

#include "trk_bridge/camera/camera.h"

namespace trk_bridge::lens::table_test {

using testing::HasSubstr;
using testing::StartsWith;

Table table_of(const std::string& yaml) {
  auto table = Table::from_yaml(yaml, "lens.yaml");
  if (!table) throw std::runtime_error(table.error());
  return *std::move(table);
}
std::string error_of(const std::string& yaml) {
  const auto table = Table::from_yaml(yaml, "lens.yaml");
  return table ? "no error" : table.error();
}
double focal_length(const Table& table, double zoom, double focus = 0) {
  const auto lens = table.lens_at({zoom, focus});
  return lens ? lens->image_distance : std::nan("");
}

const char* const three_points = R"(
points:
- {zoom: 0, focal_length: 8, k1: 0.001}
- {zoom: 10, focal_length: 12, k1: 0.001, center_x: 0.1, center_y: -0.2}
- {zoom: 30, focal_length: 40, k1: -0.002, k2: 0.0003}
)";

TEST(LensTable, PchipByHand) {
  // Lengths 10 and 20, secants 2/5 and 7/5. Slope in the middle: 90 / (50 / (2/5) + 40 / (7/5)) = 126/215; at the left
  // end ((2*10+20) * 2/5 - 10 * 7/5) / 30 = 1/15, at the right end ((2*20+10) * 7/5 - 20 * 2/5) / 30 = 31/15. Halfway
  // of an interval of length h the cubic is (f0 + f1) / 2 + h / 8 * (s0 - s1).
  const Table table = table_of(three_points);
  EXPECT_NEAR(focal_length(table, 5), 4825.0 / 516, 1e-12);
  EXPECT_NEAR(focal_length(table, 20), 5753.0 / 258, 1e-12);
  EXPECT_NEAR(focal_length(table, 2.5), 11619.0 / 1376, 1e-12);
  for (const auto& [zoom, length] : {std::pair{0.0, 8.0}, {10.0, 12.0}, {30.0, 40.0}}) {
    EXPECT_DOUBLE_EQ(focal_length(table, zoom), length);
  }
  // k1 does not change at first, and then falls: the curve never exceeds its points.
  for (double zoom = 0; zoom <= 10; zoom += 0.5) EXPECT_DOUBLE_EQ(table.lens_at({zoom, 0})->k1, 0.001);
  EXPECT_DOUBLE_EQ(table.lens_at({10, 0})->center_shift.x(), 0.1);
  EXPECT_DOUBLE_EQ(table.lens_at({10, 0})->center_shift.y(), -0.2);
  EXPECT_DOUBLE_EQ(table.lens_at({30, 0})->k2, 0.0003);
}

TEST(LensTable, LinearIfRequested) {
  const Table table = table_of(std::string("interpolation: linear") + three_points);
  EXPECT_DOUBLE_EQ(focal_length(table, 5), 10);
  EXPECT_DOUBLE_EQ(focal_length(table, 20), 26);
}

TEST(LensTable, TwoPointsAreALine) {
  const Table table = table_of("points: [{zoom: 0, focal_length: 80}, {zoom: 100, focal_length: 8}]");
  EXPECT_DOUBLE_EQ(focal_length(table, 25), 62);
}

TEST(LensTable, NothingIsExtrapolated) {
  const Table table = table_of("points: [{zoom: 100, focal_length: 8}, {zoom: 1100, focal_length: 80}]");
  EXPECT_DOUBLE_EQ(focal_length(table, 90), 8) << "the tolerance for encoders: a hundredth of the range";
  EXPECT_DOUBLE_EQ(focal_length(table, 1110), 80);
  EXPECT_FALSE(table.lens_at({89, 0}));
  EXPECT_FALSE(table.lens_at({1111, 0}));
  EXPECT_FALSE(table.lens_at({std::nan(""), 0}));
}

TEST(LensTable, AnAngleOfViewIsOverTheChip) {
  const Table table = table_of(R"(
constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}
points: [{zoom: 0, field_of_view: 90}, {zoom: 1, field_of_view: 40}]
)");
  EXPECT_NEAR(focal_length(table, 0), 4.8, 1e-12) << "half of the width at 45 degrees";
  EXPECT_EQ(table.constants()->image_height, 1080);
  EXPECT_EQ(table.constants()->fake_chip_width, 9.6);
}

const char* const breathing = R"(
interpolation: linear
points:
- {focus: 0, zoom: 0, focal_length: 8}
- {focus: 0, zoom: 100, focal_length: 80}
- {focus: 1000, zoom: 0, focal_length: 9}
- {focus: 1000, zoom: 100, focal_length: 90}
focus:
- {count: 0, distance: 0.5}
- {count: 500, distance: 1}
- {count: 1000, distance: 10}
)";

TEST(LensTable, FocusChangesTheFocalLength) {
  const Table table = table_of(breathing);
  EXPECT_DOUBLE_EQ(focal_length(table, 50, 0), 44);
  EXPECT_DOUBLE_EQ(focal_length(table, 50, 1000), 49.5);
  EXPECT_DOUBLE_EQ(focal_length(table, 50, 250), 45.375);
  EXPECT_DOUBLE_EQ(table.lens_at({50, 500})->focdist, 1);
  EXPECT_DOUBLE_EQ(table.lens_at({50, 250})->focdist, 1 / 1.5) << "halfway between 2/m and 1/m";
  EXPECT_FALSE(table.lens_at({50, 1011}));
}

TEST(LensTable, ConvertsBackToCounts) {
  const Table table = table_of(breathing);
  for (double zoom = 0; zoom <= 100; zoom += 7) {
    for (double focus = 0; focus <= 1000; focus += 90) {
      const auto lens = table.lens_at({zoom, focus});
      ASSERT_TRUE(lens);
      const auto at = table.position_of(*lens);
      ASSERT_TRUE(at);
      EXPECT_NEAR(at->zoom, zoom, 0.25);
      EXPECT_NEAR(at->focus, focus, 1e-6);
    }
  }
  camera::Lens lens;
  lens.image_distance = 49.5;
  EXPECT_NEAR(table.position_of(lens)->focus, 1000, 1e-9) << "a distance that is not given is the farthest";
  lens.focdist = 0.4;
  EXPECT_FALSE(table.position_of(lens));
  lens.focdist = 1;
  lens.image_distance = 95;
  EXPECT_FALSE(table.position_of(lens));
}

TEST(LensTable, ConvertsBackIfFocalLengthsAndDistancesDecrease) {
  const Table table = table_of(R"(
points: [{zoom: 0, focal_length: 100}, {zoom: 50, focal_length: 30}, {zoom: 100, focal_length: 10}]
focus: [{count: 0, distance: 10}, {count: 100, distance: 1}]
)");
  for (double zoom = 0; zoom <= 100; zoom += 10) {
    const auto at = table.position_of(*table.lens_at({zoom, 40}));
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->zoom, zoom, 0.25);
    EXPECT_NEAR(at->focus, 40, 1e-9);
  }
}

TEST(LensTable, FaultsAreNamedWithTheirLine) {
  EXPECT_EQ(error_of(""), "lens.yaml:1: must be a map with points");
  EXPECT_THAT(error_of("point: 1"), StartsWith("lens.yaml:1: no such key 'point', nearest is points"));
  EXPECT_THAT(error_of("points: [{zoom: 0, focal_length: 8}]"), HasSubstr("must be a list of two or more"));
  const auto second_row = [](const std::string& row) {
    return error_of("points:\n- {zoom: 10, focal_length: 8}\n- " + row + "\n");
  };
  EXPECT_EQ(second_row("{zoom: 20, focal_length: 9}"), "no error");
  EXPECT_EQ(second_row("{zoom: 10, focal_length: 9}"),
            "lens.yaml:3: zoom 10: must be more than that of the row before, 10");
  EXPECT_EQ(second_row("{zoom: 20, focal_length: 0}"), "lens.yaml:3: focal_length: must be more than 0, is 0");
  EXPECT_EQ(second_row("{zoom: 20, focal_length: x}"), "lens.yaml:3: focal_length: must be a number");
  EXPECT_EQ(second_row("{zoom: .nan, focal_length: 9}"), "lens.yaml:3: zoom: must be a number");
  EXPECT_THAT(second_row("{zoom: 20}"), HasSubstr("lens.yaml:3: either focal_length (mm) or field_of_view (degrees)"));
  EXPECT_THAT(second_row("{zoom: 20, focal_length: 9, field_of_view: 9}"), HasSubstr("lens.yaml:3: either"));
  EXPECT_THAT(second_row("{zoom: 20, field_of_view: 40}"), HasSubstr("lens.yaml:3: field_of_view: needs constants"));
  EXPECT_THAT(second_row("{zoom: 20, focal_length: 9, k3: 1}"), HasSubstr("lens.yaml:3: no such key 'k3'"));
  EXPECT_THAT(second_row("{zoom: 20, focal_length: 9, focus: 1}"), HasSubstr("in every point or in none"));
  EXPECT_THAT(second_row("{zoom: 20, focal_length: 9}\n- {zoom: 30, focal_length: 8.5}"),
              HasSubstr("lens.yaml:4: zoom 30: the focal length must rise with zoom, or fall"));
  EXPECT_THAT(error_of("points: ["), StartsWith("lens.yaml:"));
}

TEST(LensTable, NumbersThatCannotBeComputedWithAreRefused) {
  const auto second_row = [](const std::string& row) {
    return error_of("points:\n- {zoom: 10, focal_length: 8}\n- " + row + "\n");
  };
  EXPECT_EQ(second_row("{zoom: 1e17, focal_length: 9}"),
            "lens.yaml:3: zoom: the magnitude must not be more than 1e+09, is 1e+17");
  EXPECT_EQ(second_row("{zoom: 20, focal_length: 1e-300}"),
            "lens.yaml:3: focal_length: must be at least 1e-09, is 1e-300");
  EXPECT_EQ(second_row("{zoom: 10.0000000001, focal_length: 9}"),
            "lens.yaml:3: zoom 10: must be at least 0.001 more than that of the row before");
  EXPECT_EQ(error_of("constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}\n"
                     "points:\n- {zoom: 10, focal_length: 8}\n- {zoom: 20, field_of_view: 1e-320}\n"),
            "lens.yaml:4: field_of_view: must be at least 1e-09, is 9.99989e-321");
  EXPECT_EQ(error_of("constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}\n"
                     "points:\n- {zoom: 10, focal_length: 8}\n- {zoom: 20, field_of_view: 180}\n"),
            "lens.yaml:4: field_of_view: must be more than 0 and less than 180 degrees, is 180");
  // The widest allowed range can be converted back.
  const Table table = table_of("points: [{zoom: -1e9, focal_length: 1e-9}, {zoom: 1e9, focal_length: 1e9}]");
  const auto at = table.position_of(*table.lens_at({1e8, 0}));
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->zoom, 1e8, 0.25);
}

TEST(LensTable, FocusGroupsHaveTheSameZooms) {
  const std::string first = "points:\n- {focus: 0, zoom: 0, focal_length: 8}\n- {focus: 0, zoom: 1, focal_length: 9}\n";
  EXPECT_EQ(error_of(first + "- {focus: 1, zoom: 0, focal_length: 8}\n- {focus: 1, zoom: 1, focal_length: 9}\n"),
            "no error");
  EXPECT_THAT(error_of(first + "- {focus: 1, zoom: 0, focal_length: 8}\n"), HasSubstr("same zooms as the first"));
  EXPECT_THAT(error_of(first + "- {focus: 1, zoom: 0, focal_length: 8}\n- {focus: 1, zoom: 2, focal_length: 9}\n"),
              HasSubstr("lens.yaml:5: zoom 2: every focus must have the same zooms"));
  EXPECT_THAT(error_of(first + "- {focus: -1, zoom: 0, focal_length: 8}\n- {focus: -1, zoom: 1, focal_length: 9}\n"),
              HasSubstr("lens.yaml:4: focus must rise"));
  EXPECT_THAT(error_of(first + "- {focus: 1, zoom: 0, focal_length: 8}\n- {focus: 1, zoom: 1, focal_length: 9}\n"
                               "- {focus: 1, zoom: 2, focal_length: 9}\n"),
              HasSubstr("lens.yaml:6: every focus must have the same zooms"));
}

TEST(LensTable, FocusAndConstantsAreChecked) {
  const std::string points = "points: [{zoom: 0, focal_length: 8}, {zoom: 1, focal_length: 9}]\n";
  EXPECT_EQ(error_of(points + "focus:\n- {count: 0, distance: 1}\n- {count: 5, distance: 1}\n"),
            "lens.yaml:4: distance 1: must rise with the count, or fall, in all rows alike");
  EXPECT_EQ(error_of(points + "focus:\n- {count: 0, distance: 1}\n- {count: 0, distance: 2}\n"),
            "lens.yaml:4: count 0: must be more than that of the row before");
  EXPECT_THAT(error_of(points + "constants: {image_width: 1920}\n"), HasSubstr("image_height is missing"));
  EXPECT_THAT(error_of(points + "constants: {image_width: 1920.5, image_height: 1, chip_width: 1, chip_height: 1}\n"),
              HasSubstr("image_width: must be whole pixels"));
  EXPECT_EQ(error_of(points + "constants: {image_width: 0, image_height: 1, chip_width: 1, chip_height: 1}\n"),
            "lens.yaml:2: constants: " + camera::describe(camera::CameraReason::bad_constants));
  EXPECT_THAT(error_of(points + "interpolation: cubic"), HasSubstr("must be pchip or linear"));
}

TEST(LensTable, TheExampleIsValid) {
  const auto table = Table::load(LENS_EXAMPLE);
  ASSERT_TRUE(table) << table.error();
  EXPECT_EQ((*table)->points().points.size(), 18U);
  EXPECT_NEAR((*table)->lens_at({0, 65535})->image_distance, 7.6, 1e-9);
  EXPECT_NEAR((*table)->lens_at({65535, 65535})->image_distance, 18 * 7.6, 1e-9);
  EXPECT_NEAR((*table)->lens_at({0, 0})->focdist, 0.9, 1e-9);
  EXPECT_EQ(Table::load("/nowhere.yaml").error(), "/nowhere.yaml: cannot be read");
}

TEST(LensTable, ALensThatFoldsTheImageIsRefused) {
  // 1 + 3 k1 r^2 is 0 at r = 5 for k1 = -1/75; the corner of the chip is sqrt(4.8^2 + 2.7^2) = 5.507 mm away.
  const std::string constants =
      "constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}\n";
  EXPECT_THAT(
      error_of(constants + "points:\n- {zoom: 0, focal_length: 8, k1: -0.013333333}\n- {zoom: 1, focal_length: 9}\n"),
      StartsWith("lens.yaml:3: k1, k2 fold the image within its 5.50"));
}

}  // namespace trk_bridge::lens::table_test
