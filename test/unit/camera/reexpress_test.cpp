#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "random_cameras.h"

namespace trk_bridge::camera {
namespace {

using wire::CameraConstants;
using wire::CameraParams;

const CameraConstants known{0, 720, 576, 10, 6, 2, 0, 9.59, 7.19, 0, 0};

/// Numbers that no conversion would leave alone: angles outside of the canonical range, a negative zero.
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
  const CameraConstants incoming = constants_for(known, change.from);
  const CameraConstants outgoing = constants_for(known, change.to);
  const auto told = reexpress(params, change.to, &incoming, &outgoing);
  ASSERT_TRUE(told) << describe(told.error());
  EXPECT_EQ(told->format, change.to);
  EXPECT_EQ(told->id, params.id);
  EXPECT_EQ(told->counter, params.counter);
  EXPECT_EQ(same_pose_bits(*told, params), !change.pose);
  EXPECT_EQ(same_bits(told->fov, params.fov), !change.fov);
  EXPECT_EQ(same_bits(told->center_x, params.center_x) && same_bits(told->center_y, params.center_y), !change.shift);
  EXPECT_TRUE(same_bits(told->k1, params.k1) && same_bits(told->k2, params.k2));
  EXPECT_TRUE(same_bits(told->focdist, params.focdist) && same_bits(told->aperture, params.aperture));
}

TEST(Reexpress, ConvertsOnlyWhatItsOptionsConcern) {
  using namespace wire;
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

TEST(Reexpress, KeepsAnglesBetweenStudioAxes) {
  const CameraParams params = awkward(wire::euler);
  const auto told = reexpress(params, wire::euler | wire::studio_y_up, nullptr, nullptr);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->euler.x, params.euler.x);
  EXPECT_EQ(told->euler.y, params.euler.z);
  EXPECT_EQ(told->euler.z, -params.euler.y);
  EXPECT_EQ(told->euler.pan, params.euler.pan);
  EXPECT_EQ(told->euler.tilt, params.euler.tilt);
  EXPECT_EQ(told->euler.roll, params.euler.roll);
  const auto back = reexpress(*told, wire::euler, nullptr, nullptr);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, params);
}

TEST(Reexpress, IsDecodingAndEncoding) {
  test::RandomCameras random;
  const auto masks = test::meaningful_masks();
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const std::uint32_t from = masks[i];
    const std::uint32_t to = masks[(i * 331 + 77) % masks.size()];
    SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
    const CameraConstants constants = random.constants();
    const CameraConstants incoming = constants_for(constants, from);
    const CameraConstants outgoing = constants_for(constants, to);
    const Camera camera = random.camera();
    const auto params = encode(camera, from, &incoming);
    ASSERT_TRUE(params);
    const auto told = reexpress(*params, to, &incoming, &outgoing);
    ASSERT_TRUE(told) << describe(told.error());
    const auto back = decode(*told, &outgoing);
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_LE((back->pose.matrix() - camera.pose.matrix()).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(back->lens.image_distance, camera.lens.image_distance, 1e-9 * camera.lens.image_distance);
    EXPECT_LE((back->lens.center_shift - camera.lens.center_shift).norm(), 1e-9);
  }
}

TEST(Reexpress, ConvertsWhereTheConstantsChangeTheMeaning) {
  const std::uint32_t format = wire::euler | wire::field_of_view | wire::ignore_blank | wire::shift_in_pixels;
  CameraConstants incoming = known;
  incoming.fake_chip_width = 20;
  incoming.fake_chip_height = 15;
  const CameraConstants outgoing = constants_for(incoming, format);
  const CameraParams params = awkward(format);
  const auto told = reexpress(params, format, &incoming, &outgoing);
  ASSERT_TRUE(told) << describe(told.error());
  EXPECT_TRUE(same_pose_bits(*told, params));
  const auto before = decode_lens(params, &incoming);
  const auto after = decode_lens(*told, &outgoing);
  ASSERT_TRUE(before && after);
  EXPECT_GT(std::abs(told->fov - params.fov), 1);
  EXPECT_NEAR(after->image_distance, before->image_distance, 1e-12);
  EXPECT_LE((after->center_shift - before->center_shift).norm(), 1e-12);
}

TEST(Reexpress, KeepsWhatItNeedNotUnderstand) {
  // Without constants, with unusable ones, with numbers that are no camera.
  const std::uint32_t format = wire::field_of_view | wire::ignore_blank | wire::shift_in_pixels;
  CameraParams params = awkward(format);
  params.fov = 200;
  params.matrix.fill(0);
  params.center_x = std::numeric_limits<double>::infinity();
  CameraConstants unusable = known;
  unusable.image_width = 0;
  const std::array<const CameraConstants*, 3> any = {nullptr, &unusable, &known};
  for (const CameraConstants* constants : any) {
    const auto told = reexpress(params, format, constants, constants);
    ASSERT_TRUE(told) << describe(told.error());
    EXPECT_EQ(*told, params);
  }
}

TEST(Reexpress, RefusesWhatItCannotConvert) {
  const auto error = [](const CameraParams& params, std::uint32_t format, const CameraConstants* incoming,
                        const CameraConstants* outgoing) {
    const auto told = reexpress(params, format, incoming, outgoing);
    EXPECT_FALSE(told);
    return told ? CameraReason{} : told.error();
  };
  CameraParams scaled = awkward(0);
  scaled.matrix[0] = 1.1;
  EXPECT_EQ(error(scaled, wire::euler, nullptr, nullptr), CameraReason::not_a_rotation);
  CameraParams nowhere = awkward(wire::euler);
  nowhere.euler.pan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(nowhere, wire::euler | wire::studio_y_up, nullptr, nullptr), CameraReason::not_finite);
  CameraParams wide = awkward(wire::field_of_view);
  wide.fov = 180;
  EXPECT_EQ(error(wide, 0, &known, &known), CameraReason::bad_field_of_view);
  EXPECT_EQ(error(awkward(0), wire::field_of_view, &known, nullptr), CameraReason::constants_needed);
  EXPECT_EQ(error(awkward(wire::shift_in_pixels), 0, nullptr, &known), CameraReason::constants_needed);
  CameraConstants unusable = known;
  unusable.chip_width = 0;
  EXPECT_EQ(error(awkward(0), wire::shift_in_pixels, &known, &unusable), CameraReason::bad_constants);
  EXPECT_EQ(error(awkward(0), 0x400, &known, &known), CameraReason::bad_format);
  EXPECT_EQ(error(awkward(0), wire::vertical | wire::diagonal, &known, &known), CameraReason::bad_format);
}

}  // namespace
}  // namespace trk_bridge::camera
