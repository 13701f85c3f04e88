// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/format.h"

#include <gmock/gmock.h>

namespace trk_bridge::wire::format_test {

using testing::HasSubstr;

TEST(FormatWords, OnlyRelevantWordsAreWritten) {
  EXPECT_EQ(format_to_words(0),
            "matrix camera_to_studio camera_z_up studio_z_up image_distance consider_blank shift_on_chip");
  EXPECT_EQ(format_to_words(0x3FF & ~euler & ~vertical),
            "matrix studio_to_camera camera_y_up studio_y_up field_of_view diagonal ignore_blank keep_aspect "
            "shift_in_pixels");
  EXPECT_EQ(format_to_words(euler | studio_to_camera | camera_y_up),
            "euler studio_z_up image_distance consider_blank shift_on_chip");
  EXPECT_EQ(format_to_words(euler | field_of_view | ignore_blank),
            "euler studio_z_up field_of_view horizontal ignore_blank adjust_aspect shift_on_chip");
  EXPECT_EQ(format_to_words(euler | field_of_view | vertical | keep_aspect),
            "euler studio_z_up field_of_view vertical consider_blank shift_on_chip");
}

TEST(FormatWords, VerticalHasPriorityOverDiagonal) {
  EXPECT_THAT(format_to_words(field_of_view | vertical | diagonal), HasSubstr("field_of_view vertical consider"));
}

TEST(FormatWords, UnknownBitsHaveNoWord) { EXPECT_EQ(format_to_words(0xFFFFFC00), format_to_words(0)); }

TEST(FormatWords, ReadBackToAMaskWithTheSameWords) {
  for (std::uint32_t mask = 0; mask <= known_format_bits; ++mask) {
    const std::string words = format_to_words(mask);
    const auto read = format_from_words(words);
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(format_to_words(*read), words);
    EXPECT_EQ(*read & ~mask, 0U) << "bits invented for mask " << mask;
  }
}

TEST(FormatWords, AnyCaseOrderAndWhiteSpace) {
  EXPECT_EQ(format_from_words(""), 0U);
  EXPECT_EQ(format_from_words(" \t\r\n"), 0U);
  EXPECT_EQ(format_from_words("euler"), 0x001U);
  EXPECT_EQ(format_from_words("\tField_Of_View\n EULER\v diagonal "), 0x051U);
  EXPECT_EQ(format_from_words("shift_in_pixels keep_aspect ignore_blank vertical field_of_view studio_y_up camera_y_up "
                              "studio_to_camera euler"),
            0x3BFU);
}

TEST(FormatWords, TheLastOfTwoOppositesIsUsed) {
  EXPECT_EQ(format_from_words("euler matrix"), 0U);
  EXPECT_EQ(format_from_words("vertical diagonal"), 0x040U);
  EXPECT_EQ(format_from_words("diagonal vertical"), 0x020U);
  EXPECT_EQ(format_from_words("vertical horizontal"), 0U);
}

TEST(FormatWords, AnUnknownWordIsNamed) {
  const auto read = format_from_words("euler fisheye");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error(), HasSubstr("'fisheye'"));
  EXPECT_THAT(read.error(), HasSubstr("shift_in_pixels"));
  EXPECT_FALSE(format_from_words("euler,matrix"));
}

TEST(CheckWritable, RefusesUnknownBitsAndTwoAngles) {
  for (std::uint32_t mask = 0; mask <= known_format_bits; ++mask) {
    EXPECT_EQ(check_writable(mask).has_value(), (mask & 0x60) != 0x60) << mask;
  }
  ASSERT_FALSE(check_writable(0x401));
  EXPECT_THAT(check_writable(0x401).error(), HasSubstr("0x400"));
  ASSERT_FALSE(check_writable(vertical | diagonal));
  EXPECT_THAT(check_writable(vertical | diagonal).error(), HasSubstr("vertical and diagonal"));
}

}  // namespace trk_bridge::wire::format_test
