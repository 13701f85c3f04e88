// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The memory layout of the structures, and their text.
#include "trk_struct.h"

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace trk_bridge::c_api::struct_test {

// On i386, doubles in structures are aligned to 4 bytes, and unsigned long has 4.
constexpr bool is_i386 = sizeof(void*) == 4 && alignof(trkCameraParams) == 4;
#ifdef TRK_IDENTIFIED
static_assert(offsetof(trkCameraParams, id) == 0 && offsetof(trkCameraParams, format) == 4);
static_assert(offsetof(trkCameraParams, t) == 8);
static_assert(sizeof(trkCameraConstants) == (is_i386 ? 60 : 64) && offsetof(trkCameraConstants, imageWidth) == 4);
static_assert(offsetof(trkCameraConstants, chipWidth) == (is_i386 ? 28 : 32));
#else
static_assert(offsetof(trkCameraParams, format) == 0 && offsetof(trkCameraParams, t) == (is_i386 ? 4 : 8));
static_assert(sizeof(trkCameraConstants) == 56 && offsetof(trkCameraConstants, chipWidth) == 24);
#endif
constexpr std::size_t numbers = offsetof(trkCameraParams, t);
static_assert(offsetof(trkCameraParams, fov) == numbers + 128 && offsetof(trkCameraParams, aperture) == numbers + 176);
static_assert(offsetof(trkCameraParams, counter) == numbers + 184);
static_assert(sizeof(trkCameraParams) == numbers + 184 + (is_i386 ? 4 : 8));

trkCameraParams euler_params() {
  trkCameraParams p{};
  p.format = trkEuler | trkFieldOfView;
  p.t.e = {1.5, -2, 1.75, 30, -5, 0};
  p.fov = 42;
  p.centerX = 0.1;
  p.k1 = -0.001;
  p.focdist = 4.5;
  p.counter = 1234;
  return p;
}

TEST(Struct, errors_have_the_texts_that_scripts_look_for) {
  EXPECT_STREQ(trkErrorMessage(trkOK), "OK");
  EXPECT_STREQ(trkErrorMessage(trkFailed), "Operation failed !");
  EXPECT_STREQ(trkErrorMessage(trkInvalidHandle), "Invalid handle !");
  EXPECT_STREQ(trkErrorMessage(trkInvalidVersion), "Invalid version !");
  EXPECT_STREQ(trkErrorMessage(trkUnavailable), "Data unavailable !");
  EXPECT_STREQ(trkErrorMessage(static_cast<trkError>(7)), "Unknown error !");
}

TEST(Struct, parameters_as_text) {
  const trkCameraParams p = euler_params();
  char text[trkStringSize];
  ASSERT_EQ(trkParamsToString(&p, text), 51);
  EXPECT_STREQ(text, "11 1.5 -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234");
  trkCameraParams back{};
  ASSERT_EQ(trkStringToParams(text, &back), 1);
  EXPECT_EQ(back.format, p.format);
  EXPECT_EQ(back.t.e.z, 1.75);
  EXPECT_EQ(back.k1, -0.001);
  EXPECT_EQ(back.counter, 1234U);
}

TEST(Struct, matrices_are_column_major) {
  trkCameraParams p{};
  ASSERT_EQ(trkStringToParams("I7 0 1 0 0 0 1 0 0 0 1 10 20 30 7.5 0 0 0 0 0 0 9", &p), 1);
  EXPECT_EQ(p.t.m[3][0], 10);
  EXPECT_EQ(p.t.m[3][2], 30);
  EXPECT_EQ(p.t.m[3][3], 1);
  EXPECT_EQ(p.t.m[0][3], 0);
  EXPECT_EQ(p.counter, 9U);
}

TEST(Struct, constants_as_text) {
  trkCameraConstants c{};
  ASSERT_EQ(trkStringToConstants("720 576 10 8 0 2 6.4 4.8 6.5 4.9", &c), 1);
  char text[trkStringSize];
  ASSERT_EQ(trkConstantsToString(&c, text), 32);
  EXPECT_STREQ(text, "720 576 10 8 0 2 6.4 4.8 6.5 4.9");
  trkCameraConstants back{};
  ASSERT_EQ(trkStringToConstants(text, &back), 1);
  EXPECT_EQ(back.blankRight, 8);
  EXPECT_EQ(back.fakeChipHeight, 4.9);
}

TEST(Struct, malformed_texts_do_not_change_the_record) {
  trkCameraParams p = euler_params();
  for (const char* text : {"", "11 1 2 3", "11 1.5 -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234 x",
                           "11 nan -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234"}) {
    EXPECT_EQ(trkStringToParams(text, &p), 0) << text;
  }
  EXPECT_EQ(p.counter, 1234U);
  trkCameraConstants c{};
  EXPECT_EQ(trkStringToConstants("720 576", &c), 0);
}

TEST(Struct, null_pointers_have_no_text) {
  char text[trkStringSize] = "before";
  EXPECT_EQ(trkParamsToString(nullptr, text), 0);
  EXPECT_STREQ(text, "");
  const trkCameraParams p = euler_params();
  EXPECT_EQ(trkParamsToString(&p, nullptr), 0);
  EXPECT_EQ(trkFormatToString(trkEuler, nullptr), 0);
  trkCameraParams q{};
  EXPECT_EQ(trkStringToParams(nullptr, &q), 0);
  EXPECT_EQ(trkStringToFormat("euler", nullptr), 0);
}

TEST(Struct, the_longest_text_fits) {
  trkCameraParams p{};
  for (auto& column : p.t.m) {
    for (double& number : column) number = -1.2345678901234567e-300;
  }
  p.fov = p.centerX = p.centerY = p.k1 = p.k2 = p.focdist = p.aperture = -1.2345678901234567e-300;
  p.counter = std::numeric_limits<unsigned long>::max();
  char text[trkStringSize];
  const int length = trkParamsToString(&p, text);
  EXPECT_EQ(length, static_cast<int>(std::strlen(text)));
  EXPECT_GT(std::strlen(text), is_i386 ? 480U : 490U);
}

#ifdef TRK_IDENTIFIED
TEST(Struct, texts_have_the_camera_number) {
  trkCameraParams p = euler_params();
  p.id = 7;
  char text[trkStringSize];
  ASSERT_GT(trkParamsToString(&p, text), 0);
  EXPECT_EQ(std::string(text).substr(0, 6), "I7 11 ");
  trkCameraParams back{};
  ASSERT_EQ(trkStringToParams(text, &back), 1);
  EXPECT_EQ(back.id, 7U);
}
#endif

TEST(Struct, values_that_are_not_finite_have_no_text) {
  trkCameraParams p = euler_params();
  p.t.e.pan = std::numeric_limits<double>::quiet_NaN();
  char text[trkStringSize];
  EXPECT_EQ(trkParamsToString(&p, text), 0);
  EXPECT_STREQ(text, "");
}

TEST(Struct, formats_are_words) {
  char text[trkStringSize];
  ASSERT_EQ(trkFormatToString(0, text), 91);
  EXPECT_STREQ(text, "matrix camera_to_studio camera_z_up studio_z_up image_distance consider_blank shift_on_chip");
  unsigned format = 99;
  ASSERT_EQ(trkStringToFormat(" Shift_In_Pixels\tEULER\nfield_of_view vertical ignore_blank keep_aspect ", &format), 1);
  EXPECT_EQ(format,
            unsigned{trkEuler | trkFieldOfView | trkVertical | trkIgnoreBlank | trkKeepAspect | trkShiftInPixels});
  EXPECT_EQ(trkStringToFormat("euler upside_down", &format), 0);
  EXPECT_TRUE(format & trkShiftInPixels) << "unchanged";
}

}  // namespace trk_bridge::c_api::struct_test
