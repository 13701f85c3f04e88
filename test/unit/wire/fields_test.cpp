// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/fields.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/wire/codec.h"

namespace trk_bridge::wire::fields_test {

using ::testing::ElementsAre;

/// "name documentName unit" of every field.
template <class Record>
std::vector<std::string> descriptions(std::uint32_t format = 0) {
  std::vector<std::string> all;
  const Record record{};
  for_each_field<Record>(
      [&](const Field& field, const auto&) {
        all.push_back(std::string(field.name) + ' ' + field.document_name + ' ' + field.unit_in(format));
      },
      record);
  return all;
}

/// A visitor that assigns numbers to the fields in order.
auto numbers_from(int first) {
  return
      [next = first](const Field&, auto& value) mutable { value = static_cast<std::decay_t<decltype(value)>>(next++); };
}

/// The record with the visited field `which` increased by one.
template <class Record>
Record with_one_changed(Record record, std::size_t which) {
  std::size_t i = 0;
  const auto change = [&](const Field&, auto& value) {
    if (i++ == which) value += 1;
  };
  for_each_field<Record>(change, record);
  return record;
}

TEST(Fields, params_have_names_and_units_in_the_order_of_the_text) {
  EXPECT_THAT(descriptions<CameraParams>(),
              ElementsAre("id id ", "format format ", "fov fov mm", "center_x centerX mm", "center_y centerY mm",
                          "k1 k1 mm^-2", "k2 k2 mm^-4", "focdist focdist m", "aperture aperture ", "counter counter "));
  EXPECT_EQ(field_count<CameraParams>(), 10U);
}

TEST(Fields, euler_has_names_and_units_in_the_order_of_the_text) {
  EXPECT_THAT(descriptions<Euler>(),
              ElementsAre("x x m", "y y m", "z z m", "pan pan deg", "tilt tilt deg", "roll roll deg"));
  EXPECT_EQ(field_count<Euler>(), 6U);
}

TEST(Fields, constants_have_names_and_units_in_the_order_of_the_text) {
  EXPECT_THAT(descriptions<CameraConstants>(),
              ElementsAre("id id ", "image_width imageWidth px", "image_height imageHeight px",
                          "blank_left blankLeft px", "blank_right blankRight px", "blank_top blankTop px",
                          "blank_bottom blankBottom px", "chip_width chipWidth mm", "chip_height chipHeight mm",
                          "fake_chip_width fakeChipWidth mm", "fake_chip_height fakeChipHeight mm"));
  EXPECT_EQ(field_count<CameraConstants>(), 11U);
}

TEST(Fields, the_format_selects_the_units_of_fov_and_center) {
  const auto usual = descriptions<CameraParams>();
  for (const std::uint32_t format : {0x000U, 0x010U, 0x200U, 0x3FFU, ~0x210U}) {
    auto expected = usual;
    if (has(format, field_of_view)) expected[2] = "fov fov deg";
    if (has(format, shift_in_pixels)) {
      expected[3] = "center_x centerX px";
      expected[4] = "center_y centerY px";
    }
    EXPECT_EQ(descriptions<CameraParams>(format), expected) << format;
  }
}

TEST(Fields, every_member_of_params_is_visited_once) {
  CameraParams p;
  for_each_field<CameraParams>(numbers_from(1), p);
  for_each_field<Euler>(numbers_from(11), p.euler);
  // A new member of the record causes a compile error here until it is added here.
  const auto& [id, mask, matrix, angles, fov, center_x, center_y, k1, k2, focdist, aperture, counter] = p;
  EXPECT_THAT((std::vector<double>{double(id), double(mask), fov, center_x, center_y, k1, k2, focdist, aperture,
                                   double(counter)}),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  const auto& [x, y, z, pan, tilt, roll] = angles;
  EXPECT_THAT((std::vector<double>{x, y, z, pan, tilt, roll}), ElementsAre(11, 12, 13, 14, 15, 16));
  EXPECT_THAT(matrix, ::testing::Each(0)) << "it is an array and not in the list of fields";
}

TEST(Fields, every_member_of_constants_is_visited_once) {
  CameraConstants c;
  for_each_field<CameraConstants>(numbers_from(1), c);
  const auto& [id, image_width, image_height, left, right, top, bottom, chip_width, chip_height, fake_width,
               fake_height] = c;
  EXPECT_THAT((std::vector<double>{double(id), double(image_width), double(image_height), double(left), double(right),
                                   double(top), double(bottom), chip_width, chip_height, fake_width, fake_height}),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(Fields, their_order_is_that_of_the_text) {
  Buffer buffer;
  CameraConstants c;
  for_each_field<CameraConstants>(numbers_from(1), c);
  EXPECT_EQ(to_text(c, buffer).value_or(""), "I1 2 3 4 5 6 7 8 9 10 11");

  CameraParams p;
  for_each_field<CameraParams>(numbers_from(1), p);
  p.format = euler;
  for_each_field<Euler>(numbers_from(11), p.euler);
  EXPECT_EQ(to_text(p, buffer).value_or(""), "I1 1 11 12 13 14 15 16 3 4 5 6 7 8 9 10");
}

TEST(Fields, equality_notices_each_field) {
  CameraParams p;
  p.format = euler;
  for (std::size_t i = 0; i < field_count<CameraParams>(); ++i) {
    EXPECT_FALSE(with_one_changed(p, i) == p) << i;
    EXPECT_TRUE(with_one_changed(p, i) == with_one_changed(p, i)) << i;
  }
  for (std::size_t i = 0; i < field_count<Euler>(); ++i) {
    CameraParams other = p;
    other.euler = with_one_changed(p.euler, i);
    EXPECT_FALSE(other == p) << i;
    EXPECT_FALSE(same_fields(other.euler, p.euler)) << i;
  }
  const CameraConstants c;
  for (std::size_t i = 0; i < field_count<CameraConstants>(); ++i) {
    EXPECT_FALSE(with_one_changed(c, i) == c) << i;
    EXPECT_TRUE(with_one_changed(c, i) == with_one_changed(c, i)) << i;
  }
}

TEST(Fields, equality_looks_at_the_transform_of_the_format_only) {
  CameraParams matrix;
  for (std::size_t i = 0; i < matrix.matrix.size(); ++i) {
    CameraParams other = matrix;
    other.matrix[i] = 1;
    EXPECT_FALSE(other == matrix) << i;
    other.format = matrix.format = euler;
    EXPECT_TRUE(other == matrix) << i;
    matrix.format = 0;
  }
  CameraParams other = matrix;
  other.euler = with_one_changed(matrix.euler, 0);
  EXPECT_TRUE(other == matrix);
}

/// Another type with the names of Euler, but with another order and type.
struct Pose {
  float roll, tilt, pan, z, y, x;
};

TEST(Fields, are_copied_to_other_types_and_back) {
  const Euler angles{1, 2, 3, 4, 5, 6};
  Pose pose{};
  copy_fields<Euler>(angles, pose);
  EXPECT_THAT((std::vector<float>{pose.x, pose.y, pose.z, pose.pan, pose.tilt, pose.roll}),
              ElementsAre(1, 2, 3, 4, 5, 6));
  Euler back;
  copy_fields<Euler>(pose, back);
  EXPECT_TRUE(same_fields(back, angles));
}

}  // namespace trk_bridge::wire::fields_test
