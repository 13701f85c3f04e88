// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/camera/converter.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "random_cameras.h"
#include "worked_cases.h"

namespace trk_bridge::camera::converter_test {

using wire::CameraConstants;
using wire::CameraParams;

const CameraConstants known{0, 720, 576, 10, 6, 2, 0, 9.59, 7.19, 0, 0};

/// Numbers that every conversion would change: angles outside the canonical range, a negative zero.
CameraParams awkward(std::uint32_t format) {
  CameraParams params;
  params.id = 12;
  params.format = format;
  params.counter = 0xFFFFFFFFFF;
  if (wire::has(format, wire::euler)) {
    params.euler = {-0.0, 1.0 / 3, 2e-17, 725.1, 100.3, -541};
  } else {
    params.matrix = {1.0001, 0, -0.0, 0, 0, 0.9999, 0, 0, 0, 0, 1, 0, 1.0 / 3, 2, 3, 1};
  }
  params.fov = 33.3;
  params.center_x = -0.0;
  params.center_y = 0.1;
  params.k1 = 1e-3;
  params.k2 = -0.0;
  params.focdist = 5;
  params.aperture = 2.8;
  return params;
}

Converter converter_with(const CameraConstants& constants, std::optional<std::uint32_t> format) {
  Converter converter(format);
  EXPECT_EQ(converter.use(constants), ConstantsChange::changed);
  return converter;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_pose_bits(const CameraParams& a, const CameraParams& b) {
  return std::memcmp(&a.euler, &b.euler, sizeof a.euler) == 0 &&
         std::memcmp(a.matrix.data(), b.matrix.data(), sizeof a.matrix) == 0;
}

struct Change {
  const char* what;
  std::uint32_t from, to;
  bool pose, fov, shift;  ///< which of them is converted
};

void expect_kept_but(const Change& change) {
  SCOPED_TRACE(change.what);
  const CameraParams params = awkward(change.from);
  const auto out = converter_with(constants_for(known, change.from), change.to).convert(params).params;
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_EQ(out->format, change.to);
  EXPECT_EQ(out->id, params.id);
  EXPECT_EQ(out->counter, params.counter);
  EXPECT_EQ(same_pose_bits(*out, params), !change.pose);
  EXPECT_EQ(same_bits(out->fov, params.fov), !change.fov);
  EXPECT_EQ(same_bits(out->center_x, params.center_x) && same_bits(out->center_y, params.center_y), !change.shift);
  EXPECT_TRUE(same_bits(out->k1, params.k1) && same_bits(out->k2, params.k2));
  EXPECT_TRUE(same_bits(out->focdist, params.focdist) && same_bits(out->aperture, params.aperture));
}

TEST(Converter, ConvertsOnlyWhatItsOptionsAffect) {
  using namespace wire;
  using wire::field_of_view;
  const std::uint32_t fake_pixels = ignore_blank | shift_in_pixels;
  const Change changes[] = {
      {"nothing", euler, euler, false, false, false},
      {"matrix options under euler", euler, euler | studio_to_camera | camera_y_up, false, false, false},
      {"studio axes under euler", euler, euler | studio_y_up, true, false, false},
      {"direction of a matrix", 0, studio_to_camera, true, false, false},
      {"camera axes of a matrix", 0, camera_y_up, true, false, false},
      {"studio axes of a matrix", 0, studio_y_up, true, false, false},
      {"matrix to euler", 0, euler, true, false, false},
      {"sides without an angle", 0, vertical, false, false, false},
      {"image distance to angle", 0, field_of_view, false, true, false},
      {"horizontal to vertical", field_of_view, field_of_view | vertical, false, true, false},
      {"both to vertical", field_of_view | vertical | diagonal, field_of_view | vertical, false, false, false},
      {"both to diagonal", field_of_view | vertical | diagonal, field_of_view | diagonal, false, true, false},
      {"aspect with blanks considered", field_of_view | shift_in_pixels, field_of_view | shift_in_pixels | keep_aspect,
       false, false, false},
      {"blanks with an image distance", 0, ignore_blank, false, false, true},
      {"blanks with an angle", field_of_view, field_of_view | ignore_blank, false, true, true},
      {"aspect with an image distance and a shift on the chip", ignore_blank, ignore_blank | keep_aspect, false, false,
       false},
      {"aspect of an angle", ignore_blank | field_of_view | vertical,
       ignore_blank | field_of_view | vertical | keep_aspect, false, true, false},
      {"aspect of a shift in pixels", fake_pixels, fake_pixels | keep_aspect, false, false, true},
      {"shift in pixels", 0, shift_in_pixels, false, false, true},
      {"unknown bits away", euler | 0xFC00, euler, false, false, false},
  };
  for (const auto& change : changes) expect_kept_but(change);
}

TEST(Converter, KeepsAnglesBetweenStudioAxes) {
  const CameraParams params = awkward(wire::euler);
  const auto out = Converter(wire::euler | wire::studio_y_up).convert(params).params;
  ASSERT_TRUE(out);
  EXPECT_EQ(out->euler.x, params.euler.x);
  EXPECT_EQ(out->euler.y, params.euler.z);
  EXPECT_EQ(out->euler.z, -params.euler.y);
  EXPECT_EQ(out->euler.pan, params.euler.pan);
  EXPECT_EQ(out->euler.tilt, params.euler.tilt);
  EXPECT_EQ(out->euler.roll, params.euler.roll);
  const auto back = Converter(wire::euler).convert(*out).params;
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, params);
}

TEST(Converter, IsDecodingAndEncoding) {
  test::RandomCameras random;
  const auto masks = test::meaningful_masks();
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const std::uint32_t from = masks[i];
    const std::uint32_t to = masks[(i * 331 + 77) % masks.size()];
    SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
    const CameraConstants constants = random.constants();
    const CameraConstants incoming = constants_for(constants, from);
    const Converter converter = converter_with(incoming, to);
    const Camera camera = random.camera();
    const auto params = encode(camera, from, &incoming);
    ASSERT_TRUE(params);
    const auto out = converter.convert(*params).params;
    ASSERT_TRUE(out) << describe(out.error());
    const auto back = decode(*out, converter.outgoing());
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_LE((back->pose.matrix() - camera.pose.matrix()).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(back->lens.image_distance, camera.lens.image_distance, 1e-9 * camera.lens.image_distance);
    EXPECT_LE((back->lens.center_shift - camera.lens.center_shift).norm(), 1e-9);
  }
}

TEST(Converter, ConvertsIfTheConstantsChangeTheMeaning) {
  const std::uint32_t format = wire::euler | wire::field_of_view | wire::ignore_blank | wire::shift_in_pixels;
  CameraConstants incoming = known;
  incoming.fake_chip_width = 20;
  incoming.fake_chip_height = 15;
  const Converter converter = converter_with(incoming, format);
  const CameraParams params = awkward(format);
  const auto out = converter.convert(params).params;
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_TRUE(same_pose_bits(*out, params));
  const auto before = decode_lens(params, &incoming);
  const auto after = decode_lens(*out, converter.outgoing());
  ASSERT_TRUE(before && after);
  EXPECT_GT(std::abs(out->fov - params.fov), 1);
  EXPECT_NEAR(after->image_distance, before->image_distance, 1e-12);
  EXPECT_LE((after->center_shift - before->center_shift).norm(), 1e-12);
}

TEST(Converter, KeepsWhatNeedsNoConversion) {
  // Without and with constants; numbers that are no camera.
  const std::uint32_t format = wire::field_of_view | wire::ignore_blank | wire::shift_in_pixels;
  CameraParams params = awkward(format);
  params.fov = 200;
  params.matrix.fill(0);
  params.center_x = std::numeric_limits<double>::infinity();
  Converter converter(format);
  for (int i = 0; i < 2; ++i) {
    const Converted converted = converter.convert(params);
    ASSERT_TRUE(converted.params) << describe(converted.params.error());
    EXPECT_EQ(*converted.params, params);
    ASSERT_FALSE(converted.pose);
    EXPECT_EQ(converted.pose.error(), CameraReason::not_a_rotation);
    ASSERT_FALSE(converted.lens);
    EXPECT_EQ(converted.lens.error(), i == 0 ? CameraReason::constants_needed : CameraReason::bad_field_of_view);
    EXPECT_NE(converter.use(known), ConstantsChange::invalid);
  }
}

TEST(Converter, RefusesWhatItCannotConvert) {
  const auto error = [](const CameraParams& params, const Converter& converter) {
    const auto out = converter.convert(params).params;
    EXPECT_FALSE(out);
    return out ? CameraReason{} : out.error();
  };
  CameraParams scaled = awkward(0);
  scaled.matrix[0] = 1.1;
  EXPECT_EQ(error(scaled, Converter(wire::euler)), CameraReason::not_a_rotation);
  CameraParams nowhere = awkward(wire::euler);
  nowhere.euler.pan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(nowhere, Converter(wire::euler | wire::studio_y_up)), CameraReason::not_finite);
  CameraParams wide = awkward(wire::field_of_view);
  wide.fov = 180;
  EXPECT_EQ(error(wide, converter_with(known, 0)), CameraReason::bad_field_of_view);
  EXPECT_EQ(error(awkward(0), Converter(wire::field_of_view)), CameraReason::constants_needed);
  EXPECT_EQ(error(awkward(wire::shift_in_pixels), Converter(0)), CameraReason::constants_needed);
  EXPECT_EQ(error(awkward(0), converter_with(known, 0x400)), CameraReason::bad_format);
  EXPECT_EQ(error(awkward(0), converter_with(known, wire::vertical | wire::diagonal)), CameraReason::bad_format);
}

TEST(Converter, FailsPartByPart) {
  CameraParams params = awkward(wire::field_of_view);
  params.matrix[0] = 1.1;
  const Converted without_constants = Converter(wire::field_of_view).convert(params);
  EXPECT_FALSE(without_constants.pose);
  EXPECT_FALSE(without_constants.lens);
  EXPECT_TRUE(without_constants.params);
  const Converted converted = converter_with(known, wire::euler).convert(params);
  EXPECT_FALSE(converted.pose);
  EXPECT_TRUE(converted.lens);
  EXPECT_FALSE(converted.params);
}

TEST(Converter, DoesNotChangeRecordsWithoutAFormat) {
  // A format that is not possible, a matrix that is no rotation.
  CameraParams params = awkward(0xFC00 | wire::field_of_view | wire::vertical | wire::diagonal);
  params.matrix[0] = 1.1;
  const Converter converter = converter_with(known, std::nullopt);
  EXPECT_FALSE(converter.format());
  EXPECT_EQ(*converter.outgoing(), known);
  const Converted converted = converter.convert(params);
  ASSERT_TRUE(converted.params);
  EXPECT_EQ(*converted.params, params);
  EXPECT_TRUE(same_pose_bits(*converted.params, params));
  EXPECT_FALSE(converted.pose);
  EXPECT_TRUE(converted.lens);
}

TEST(Converter, TakesConstants) {
  const std::uint32_t format = wire::ignore_blank | wire::keep_aspect;
  Converter converter(format);
  EXPECT_EQ(converter.format(), format);
  EXPECT_EQ(converter.incoming(), nullptr);
  EXPECT_EQ(converter.outgoing(), nullptr);

  CameraConstants constants = known;
  constants.id = 7;
  EXPECT_EQ(converter.use(constants), ConstantsChange::changed);
  EXPECT_EQ(converter.use(constants), ConstantsChange::unchanged);
  EXPECT_EQ(*converter.incoming(), constants);
  CameraConstants expected = constants;
  expected.fake_chip_width = 9.59 * 720 / 704;
  expected.fake_chip_height = 7.19 * 720 / 704;
  ASSERT_NE(converter.outgoing(), nullptr);
  EXPECT_EQ(converter.outgoing()->id, 7U);
  EXPECT_NEAR(converter.outgoing()->fake_chip_width, expected.fake_chip_width, 1e-12);
  EXPECT_NEAR(converter.outgoing()->fake_chip_height, expected.fake_chip_height, 1e-12);

  constants.id = 8;
  EXPECT_EQ(converter.use(constants), ConstantsChange::changed);
  EXPECT_EQ(converter.outgoing()->id, 8U);
  constants.blank_top = 3;
  EXPECT_EQ(converter.use(constants), ConstantsChange::changed);
  EXPECT_EQ(*converter.incoming(), constants);
  EXPECT_EQ(converter.outgoing()->blank_top, 3);
}

TEST(Converter, KeepsTheConstantsIfNewOnesAreInvalid) {
  Converter converter(wire::field_of_view);
  CameraConstants invalid = known;
  invalid.image_width = 0;
  EXPECT_EQ(converter.use(invalid), ConstantsChange::invalid);
  EXPECT_EQ(converter.incoming(), nullptr);
  EXPECT_EQ(converter.use(known), ConstantsChange::changed);
  EXPECT_EQ(converter.use(invalid), ConstantsChange::invalid);
  ASSERT_NE(converter.incoming(), nullptr);
  EXPECT_EQ(*converter.incoming(), known);
  EXPECT_TRUE(converter.convert(awkward(0)).params);
  EXPECT_EQ(converter.use(known), ConstantsChange::unchanged);
}

TEST(Converter, ForgetsTheConstants) {
  Converter converter = converter_with(known, wire::field_of_view);
  converter.forget();
  EXPECT_EQ(converter.incoming(), nullptr);
  EXPECT_EQ(converter.outgoing(), nullptr);
  EXPECT_FALSE(converter.convert(awkward(0)).params);
  EXPECT_EQ(converter.use(known), ConstantsChange::changed);
}

TEST(Converter, ConvertsCanonicalCameras) {
  test::RandomCameras random;
  const Camera camera = random.camera();
  const auto plain = Converter().convert(camera);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->format, wire::euler);
  EXPECT_EQ(plain->id, 0U);
  EXPECT_EQ(plain->counter, 0U);
  EXPECT_EQ(plain->fov, camera.lens.image_distance);
  EXPECT_EQ(plain->euler.x, camera.pose.translation().x());

  const std::uint32_t format = wire::field_of_view | wire::ignore_blank;
  const auto needy = Converter(format).convert(camera);
  ASSERT_FALSE(needy);
  EXPECT_EQ(needy.error(), CameraReason::constants_needed);
  const Converter converter = converter_with(known, format);
  const auto params = converter.convert(camera);
  ASSERT_TRUE(params);
  EXPECT_EQ(params->format, format);
  const double fake_width = 9.59 * 720 / 704;
  EXPECT_NEAR(params->fov, 2 * std::atan(fake_width / 2 / camera.lens.image_distance) * 180 / M_PI, 1e-12);
  const auto refused = Converter(0x400).convert(camera);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), CameraReason::bad_format);
}

void expect_near(double actual, double expected, double tolerance, const char* what) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << actual << " instead of " << expected;
}

void expect_same_params(const CameraParams& actual, const CameraParams& expected, double tolerance) {
  EXPECT_EQ(actual.format, expected.format);
  EXPECT_EQ(actual.id, expected.id);
  EXPECT_EQ(actual.counter, expected.counter);
  if (wire::has(expected.format, wire::euler)) {
    expect_near(actual.euler.x, expected.euler.x, tolerance, "x");
    expect_near(actual.euler.y, expected.euler.y, tolerance, "y");
    expect_near(actual.euler.z, expected.euler.z, tolerance, "z");
    const Eigen::Matrix3d a = rotation_of({actual.euler.pan, actual.euler.tilt, actual.euler.roll});
    const Eigen::Matrix3d b = rotation_of({expected.euler.pan, expected.euler.tilt, expected.euler.roll});
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance);
  } else {
    for (std::size_t i = 0; i < 16; ++i) expect_near(actual.matrix[i], expected.matrix[i], tolerance, "matrix");
  }
  expect_near(actual.fov, expected.fov, tolerance, "fov");
  expect_near(actual.center_x, expected.center_x, tolerance, "centerX");
  expect_near(actual.center_y, expected.center_y, tolerance, "centerY");
  EXPECT_EQ(actual.k1, expected.k1);
  EXPECT_EQ(actual.k2, expected.k2);
  EXPECT_EQ(actual.focdist, expected.focdist);
  EXPECT_EQ(actual.aperture, expected.aperture);
}

TEST(Converter, RoundTripsTheWorkedCases) {
  constexpr double tolerance = 1e-9;
  const auto cases = test::worked_cases();
  const auto masks = test::meaningful_masks();
  for (std::size_t i = 0; i < cases.size() * 8 && !HasFailure(); ++i) {
    const auto& c = cases[i / 8];
    const std::uint32_t format = masks[(i * 331 + 77) % masks.size()];
    SCOPED_TRACE("mask " + std::to_string(c.mask) + " to " + std::to_string(format));
    CameraParams params = c.params;
    params.id = static_cast<std::uint32_t>(i);
    params.counter = i + 1;
    const Converter there = converter_with(c.constants, format);
    const Converted converted = there.convert(params);
    ASSERT_TRUE(converted.pose && converted.lens && converted.params);
    EXPECT_LE((converted.pose->matrix() - c.camera.pose.matrix()).cwiseAbs().maxCoeff(), tolerance);
    expect_near(converted.lens->image_distance, c.camera.lens.image_distance, tolerance, "image distance");
    EXPECT_LE((converted.lens->center_shift - c.camera.lens.center_shift).norm(), tolerance);
    auto expected = there.convert(c.camera);
    ASSERT_TRUE(expected);
    expected->id = params.id;
    expected->counter = params.counter;
    expect_same_params(*converted.params, *expected, tolerance);
    const auto back = converter_with(*there.outgoing(), c.mask).convert(*converted.params);
    ASSERT_TRUE(back.params);
    expect_same_params(*back.params, params, tolerance);
  }
}

}  // namespace trk_bridge::camera::converter_test
