// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One motion, written by the document's test program in three formats.
#include <gmock/gmock.h>

#include <cmath>

#include "trk_bridge/camera/converter.h"
#include "trk_bridge/wire/codec.h"
#include "vectors.h"

namespace trk_bridge::camera::takes_test {

struct Take {
  wire::CameraConstants constants;
  std::vector<wire::CameraParams> params;
};

Take read_take(const std::string& name) {
  std::ifstream in(test::data_path("field/takes/" + name + ".trk"));
  Take take;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (number == 6) take.constants = wire::constants_from_text(line).value();
    if (number >= 8) take.params.push_back(wire::params_from_text(line).value());
  }
  return take;
}

void expect_same_camera(const Camera& a, const Camera& b) {
  // Six digits of angles of up to 180 degrees, of metres, of a field of view of up to 80 degrees.
  EXPECT_LE((a.pose.linear() - b.pose.linear()).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LE((a.pose.translation() - b.pose.translation()).norm(), 1e-5);
  EXPECT_NEAR(a.lens.image_distance, b.lens.image_distance, 1e-5 * b.lens.image_distance);
  EXPECT_LE((a.lens.center_shift - b.lens.center_shift).norm(), 1e-5);
}

class Takes : public ::testing::TestWithParam<const char*> {};

TEST_P(Takes, AreTheSameMotion) {
  const Take reference = read_take("euler");
  const Take take = read_take(GetParam());
  Converter converter(reference.params.front().format);
  ASSERT_EQ(converter.use(take.constants), ConstantsChange::changed);
  ASSERT_EQ(reference.params.size(), 2259U);
  ASSERT_EQ(take.params.size(), reference.params.size());
  for (std::size_t i = 0; i < take.params.size() && !HasFailure(); ++i) {
    SCOPED_TRACE("set " + std::to_string(i + 1));
    const auto expected = decode(reference.params[i], &reference.constants);
    const auto camera = decode(take.params[i], &take.constants);
    ASSERT_TRUE(expected && camera);
    expect_same_camera(*camera, *expected);
    ASSERT_EQ(reference.params[i].format, reference.params.front().format);
    const auto out = converter.convert(take.params[i]).params;
    ASSERT_TRUE(out) << describe(out.error());
    EXPECT_NEAR(out->fov, reference.params[i].fov, 1e-5 * out->fov);
    EXPECT_NEAR(out->center_x, reference.params[i].center_x, 1e-6);
    EXPECT_NEAR(out->euler.y, reference.params[i].euler.y, 1e-5);
    EXPECT_NEAR(std::remainder(out->euler.pan - reference.params[i].euler.pan, 360), 0, 1e-3);
  }
}

TEST_P(Takes, AreUnchangedInTheirOwnFormat) {
  const Take take = read_take(GetParam());
  Converter converter(take.params.front().format);
  ASSERT_EQ(converter.use(take.constants), ConstantsChange::changed);
  EXPECT_EQ(*converter.outgoing(), take.constants);
  for (const auto& params : take.params) {
    const auto out = converter.convert(params).params;
    ASSERT_TRUE(out);
    ASSERT_EQ(*out, params);
  }
}

INSTANTIATE_TEST_SUITE_P(Field, Takes,
                         ::testing::Values("euler-ignore_blank-keep_aspect-field_of_view-vertical",
                                           "matrix-studio_to_camera-camera_y_up-studio_y_up"));

}  // namespace trk_bridge::camera::takes_test
