// The structures as the field lays them out, and their text.
#include <trk/trk_struct.h>

#include <cstddef>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

static_assert(sizeof(trkCameraParams) == 200 && offsetof(trkCameraParams, t) == 8);
static_assert(offsetof(trkCameraParams, fov) == 136 && offsetof(trkCameraParams, aperture) == 184);
static_assert(offsetof(trkCameraParams, counter) == 192);
static_assert(sizeof(trkCameraConstants) == 56 && offsetof(trkCameraConstants, chipWidth) == 24);

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

TEST(Struct, errors_have_different_messages) {
  std::set<std::string> messages;
  for (const trkError e : {trkOK, trkFailed, trkInvalidHandle, trkInvalidVersion, trkUnavailable}) {
    messages.insert(trkErrorMessage(e));
  }
  EXPECT_EQ(messages.size(), 5U);
  EXPECT_STREQ(trkErrorMessage(static_cast<trkError>(7)), "unknown error");
}

TEST(Struct, parameters_as_text) {
  const trkCameraParams p = euler_params();
  char text[trkStringSize];
  ASSERT_EQ(trkParamsToString(&p, text, sizeof text), trkOK);
  EXPECT_STREQ(text, "11 1.5 -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234");
  trkCameraParams back{};
  ASSERT_EQ(trkStringToParams(text, &back), trkOK);
  EXPECT_EQ(back.format, p.format);
  EXPECT_EQ(back.t.e.z, 1.75);
  EXPECT_EQ(back.k1, -0.001);
  EXPECT_EQ(back.counter, 1234U);
}

TEST(Struct, matrices_go_column_after_column) {
  trkCameraParams p{};
  ASSERT_EQ(trkStringToParams("I7 0 1 0 0 0 1 0 0 0 1 10 20 30 7.5 0 0 0 0 0 0 9", &p), trkOK);
  EXPECT_EQ(p.t.m[3][0], 10);
  EXPECT_EQ(p.t.m[3][2], 30);
  EXPECT_EQ(p.t.m[3][3], 1);
  EXPECT_EQ(p.t.m[0][3], 0);
  EXPECT_EQ(p.counter, 9U);
}

TEST(Struct, constants_as_text) {
  const trkCameraConstants c{720, 576, 10, 8, 0, 2, 6.4, 4.8, 6.5, 4.9};
  char text[trkStringSize];
  ASSERT_EQ(trkConstantsToString(&c, text, sizeof text), trkOK);
  EXPECT_STREQ(text, "720 576 10 8 0 2 6.4 4.8 6.5 4.9");
  trkCameraConstants back{};
  ASSERT_EQ(trkStringToConstants(text, &back), trkOK);
  EXPECT_EQ(back.blankRight, 8);
  EXPECT_EQ(back.fakeChipHeight, 4.9);
}

TEST(Struct, texts_that_are_not_sound_leave_the_record_as_it_was) {
  trkCameraParams p = euler_params();
  for (const char* text : {"", "11 1 2 3", "11 1.5 -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234 x",
                           "11 nan -2 1.75 30 -5 0 42 0.1 0 -0.001 0 4.5 0 1234"}) {
    EXPECT_EQ(trkStringToParams(text, &p), trkInvalidVersion) << text;
  }
  EXPECT_EQ(p.counter, 1234U);
  trkCameraConstants c{};
  EXPECT_EQ(trkStringToConstants("720 576", &c), trkInvalidVersion);
}

TEST(Struct, a_text_that_does_not_fit_is_none) {
  const trkCameraParams p = euler_params();
  char text[trkStringSize];
  ASSERT_EQ(trkParamsToString(&p, text, sizeof text), trkOK);
  const std::string whole = text;
  EXPECT_EQ(trkParamsToString(&p, text, whole.size()), trkFailed);
  EXPECT_STREQ(text, "");
  EXPECT_EQ(trkParamsToString(&p, text, whole.size() + 1), trkOK);
  EXPECT_EQ(text, whole);
}

TEST(Struct, what_is_not_finite_has_no_text) {
  trkCameraParams p = euler_params();
  p.t.e.pan = std::numeric_limits<double>::quiet_NaN();
  char text[trkStringSize];
  EXPECT_EQ(trkParamsToString(&p, text, sizeof text), trkFailed);
}

TEST(Struct, formats_are_words) {
  char text[trkStringSize];
  ASSERT_EQ(trkFormatToString(0, text, sizeof text), trkOK);
  EXPECT_STREQ(text, "matrix camera_to_studio camera_z_up studio_z_up image_distance consider_blank shift_on_chip");
  unsigned format = 99;
  ASSERT_EQ(trkStringToFormat(" Shift_In_Pixels\tEULER\nfield_of_view vertical ignore_blank keep_aspect ", &format),
            trkOK);
  EXPECT_EQ(format,
            unsigned{trkEuler | trkFieldOfView | trkVertical | trkIgnoreBlank | trkKeepAspect | trkShiftInPixels});
  EXPECT_EQ(trkStringToFormat("euler upside_down", &format), trkFailed);
  EXPECT_TRUE(format & trkShiftInPixels) << "left as it was";
}

}  // namespace
