// The document's six test programs as their users run them.
#include <cmath>
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "file/take.h"
#include "free_slot.h"
#include "program.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "trk_bridge/camera/camera.h"
#include "vectors.h"

namespace trk_bridge::programs {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string program(const std::string& name) { return std::string(TEST_PROGRAMS) + "/" + name; }

struct FieldTake {
  std::string name;
  std::vector<std::string> words;
};

class WriteFile : public ::testing::TestWithParam<FieldTake> {};

/// The field prints 6 significant digits, of matrices and of small numbers more.
void expect_printed(double got, double printed, const std::string& what) {
  EXPECT_NEAR(got, printed, 1e-12 + 6e-6 * std::abs(printed)) << what;
}

TEST_P(WriteFile, moves_as_the_fields_program_does) {
  const test::TemporaryDirectory directory;
  const std::string name = directory / "take.trk";
  std::vector<std::string> command{program("write_file"), "--timecode", "03:13:51:00:1", name};
  command.insert(command.end(), GetParam().words.begin(), GetParam().words.end());
  test::Program writer(command);
  EXPECT_EQ(writer.rest_of_err(), "");
  ASSERT_EQ(writer.wait(), 0);

  const auto got = file::read_take(name);
  const auto field = file::read_take(test::data_path("field/takes/" + GetParam().name));
  EXPECT_EQ(got.time_code, field.time_code);
  EXPECT_EQ(got.constants.image_width, field.constants.image_width);
  EXPECT_EQ(got.constants.blank_right, field.constants.blank_right);
  expect_printed(got.constants.fake_chip_width, field.constants.fake_chip_width, "fake chip width");
  expect_printed(got.constants.fake_chip_height, field.constants.fake_chip_height, "fake chip height");
  ASSERT_EQ(got.params.size(), 2259U);
  ASSERT_EQ(field.params.size(), 2259U);
  for (std::size_t i = 0; i < field.params.size(); ++i) {
    const auto& g = got.params[i];
    const auto& f = field.params[i];
    const std::string what = "field " + std::to_string(i);
    ASSERT_EQ(g.format, f.format) << what;
    ASSERT_EQ(g.counter, f.counter) << what;
    const auto g_pose = camera::decode_pose(g), f_pose = camera::decode_pose(f);
    ASSERT_TRUE(g_pose && f_pose) << what;
    const auto printed = [](double a, double b) { return std::abs(a - b) <= 1e-7 + 6e-6 * std::abs(b); };
    // An angle of 6 digits is exact to 5e-5 degrees.
    ASSERT_LE((g_pose->linear() - f_pose->linear()).cwiseAbs().maxCoeff(), 2e-6) << what;
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_PRED2(printed, g_pose->translation()[axis], f_pose->translation()[axis]) << what;
    ASSERT_PRED2(printed, g.euler.pan, f.euler.pan) << what;
    ASSERT_PRED2(printed, g.euler.tilt, f.euler.tilt) << what;
    ASSERT_PRED2(printed, g.euler.roll, f.euler.roll) << what;
    ASSERT_PRED2(printed, g.fov, f.fov) << what;
    ASSERT_PRED2(printed, g.center_x, f.center_x) << what;
    ASSERT_PRED2(printed, g.center_y, f.center_y) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(Takes, WriteFile,
                         ::testing::Values(FieldTake{"euler.trk", {"euler"}},
                                           FieldTake{
                                               "euler-ignore_blank-keep_aspect-field_of_view-vertical.trk",
                                               {"euler", "ignore_blank", "keep_aspect", "field_of_view", "vertical"}},
                                           FieldTake{"matrix-studio_to_camera-camera_y_up-studio_y_up.trk",
                                                     {"matrix", "studio_to_camera", "camera_y_up", "studio_y_up"}}));

TEST(ReadFile, prints_every_set) {
  test::Program reader({program("read_file"), test::data_path("field/takes/euler.trk")});
  EXPECT_EQ(reader.out_line(), "time code: 03:13:51:00:1");
  EXPECT_EQ(reader.out_line(),
            "constants: image 720 x 576 pixels, blank left 10 right 10 top 0 bottom 0, chip 6.4 x 4.8 mm, fake chip "
            "6.58286 x 4.8 mm");
  EXPECT_EQ(
      reader.out_line(),
      "counter 1: euler studio_z_up image_distance consider_blank shift_on_chip: x 0 y -2 z 1.5 m, pan 0 tilt 0 roll "
      "0 deg, image distance 7.72548 mm, center shift 0 0 mm, k1 0 k2 0, focdist 0 m, aperture 0");
  const std::string rest = reader.rest_of_out();
  EXPECT_EQ(std::count(rest.begin(), rest.end(), '\n'), 2258);
  EXPECT_EQ(reader.wait(), 0);
}

/// Reads until parameters come, then ends both orderly.
void expect_transfer(test::Program& writer, test::Program& reader) {
  bool constants = false, params = false;
  for (int i = 0; i < 20 && !(constants && params); ++i) {
    const auto line = reader.out_line();
    ASSERT_TRUE(line) << reader.rest_of_err();
    constants = constants || line->rfind("constants: image 720 x 576", 0) == 0;
    params = params || line->rfind("counter ", 0) == 0;
  }
  EXPECT_TRUE(constants && params);
  reader.signal(SIGINT);
  reader.rest_of_out();
  EXPECT_EQ(reader.wait(), 0);
  writer.signal(SIGTERM);
  EXPECT_EQ(writer.rest_of_err(), "");
  EXPECT_EQ(writer.wait(), 0);
}

TEST(Memory, write_mem_to_read_mem) {
  test::FreeSlot slot;
  {
    test::Program writer({program("write_mem"), std::to_string(slot.number()), "euler", "studio_y_up"});
    test::Program reader({program("read_mem"), std::to_string(slot.number())});
    expect_transfer(writer, reader);
  }
  EXPECT_FALSE(slot.has_file());
}

TEST(Net, write_net_to_read_net) {
  for (const char* encoding : {"ascii", "binary"}) {
    const test::ReservedPort port;
    test::Program reader({program("read_net"), port.text()});
    test::Program writer({program("write_net"), "127.0.0.1", port.text(), encoding});
    expect_transfer(writer, reader);
  }
}

TEST(Usage, no_arguments_bring_up_what_is_required) {
  for (const char* name : {"read_mem", "write_mem", "read_net", "write_net", "read_file", "write_file"}) {
    test::Program usage({program(name)});
    const std::string text = usage.rest_of_err();
    EXPECT_THAT(text, HasSubstr("Usage: " + std::string(name))) << name;
    EXPECT_THAT(text, HasSubstr("REQUIRED")) << name;
    EXPECT_EQ(usage.wait(), 2) << name;
  }
}

TEST(Usage, bad_arguments_are_named) {
  const test::TemporaryDirectory directory;
  test::Program word({program("write_file"), directory / "x.trk", "upside_down"});
  EXPECT_THAT(word.rest_of_err(), HasSubstr("upside_down"));
  EXPECT_EQ(word.wait(), 2);
  test::Program slot({program("read_mem"), "62"});
  EXPECT_THAT(slot.rest_of_err(), StartsWith("read_mem: error: slot 62: failed"));
  EXPECT_EQ(slot.wait(), 1);
}

}  // namespace
}  // namespace trk_bridge::programs
