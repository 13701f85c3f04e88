// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tools/lens_table.h"

#include <gmock/gmock.h>

namespace trk_bridge::tools::lens_table_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

lens::Table table_of(const std::string& yaml) {
  auto table = lens::Table::from_yaml(yaml, "lens.yaml");
  if (!table) throw std::runtime_error(table.error());
  return *std::move(table);
}

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++count;
  return count;
}

TEST(LensReport, DescribesATable) {
  // 9.6 mm of chip over 4.8 mm are 90 degrees, over 48 mm 2 * atan(0.1) = 11.4212 degrees. At 4.8 mm, k1 = 0.001 moves
  // points by 0.001 * 4.8^2 = 2.304 %.
  EXPECT_THAT(
      lines_of(table_of(R"(
constants: {image_width: 1920, image_height: 1080, chip_width: 9.6, chip_height: 5.4}
interpolation: linear
points: [{zoom: 100, focal_length: 4.8, k1: 0.001, center_x: 0.02}, {zoom: 900, focal_length: 48}]
focus: [{count: 5, distance: 4}, {count: 9, distance: 0.5}]
)")),
      ElementsAre("2 points, linear over zoom", "zoom: 100 to 900 counts", "focal length: 4.8 to 48 mm",
                  "horizontal angle of view: 11.4212 to 90 degrees on a chip of 9.6 mm",
                  "centre shift: x 0 to 0.02 mm, y 0 mm", "distortion at 4.8 mm from the optical axis: 0 to 2.304 %",
                  "focus: 5 to 9 counts, 0.5 to 4 m"));
}

TEST(LensReport, ReportsWhatIsNotKnown) {
  EXPECT_THAT(lines_of(table_of("points: [{zoom: 0, focal_length: 8}, {zoom: 1, focal_length: 9}]")),
              ElementsAre("2 points, pchip over zoom", "zoom: 0 to 1 counts", "focal length: 8 to 9 mm",
                          "centre shift: x 0 mm, y 0 mm", "distortion at 1 mm from the optical axis: 0 %",
                          "focus: distances are not known",
                          "constants: none; takes need them, and nodes need them as parameter"));
}

TEST(LensPlot, DrawsEveryPointAndCurve) {
  const auto table = lens::Table::load(LENS_EXAMPLE);
  ASSERT_TRUE(table) << table.error();
  const std::string svg = to_svg(**table, "a < b");
  // Of 18 points: focal length, shift x and y, distortion; and 5 of focus.
  EXPECT_EQ(count_of("<circle", svg), 4 * 18u + 5);
  // At the first and the last focus: focal length, shift x and y, distortion; and the focus distance.
  EXPECT_EQ(count_of("<polyline", svg), 2 * 4u + 1);
  EXPECT_THAT(svg, HasSubstr(">a &lt; b</text>"));
  EXPECT_THAT(svg, HasSubstr(">focal length, mm</text>"));
  EXPECT_THAT(svg, HasSubstr(">focus distance, m</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  const std::string flat = to_svg(table_of("points: [{zoom: 0, focal_length: 8}, {zoom: 1, focal_length: 9}]"), "");
  EXPECT_THAT(flat, Not(HasSubstr("nan"))) << "centre shift and distortion are 0 everywhere";
  EXPECT_THAT(flat, Not(HasSubstr("focus distance")));
}

}  // namespace trk_bridge::tools::lens_table_test
