// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The document's six test programs, run like a user does.
#include <cmath>
#include <csignal>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "free_slot.h"
#include "program.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "trk_bridge/camera/camera.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::programs::programs_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string program(const std::string& name) { return std::string(TEST_PROGRAMS) + "/" + name; }

struct FieldTake {
  std::string name;
  std::vector<std::string> words;
};

class WriteFile : public ::testing::TestWithParam<FieldTake> {};

/// The document's programs print 6 significant digits, and more of matrices and of small numbers.
void expect_printed(double got, double printed, const std::string& what) {
  EXPECT_NEAR(got, printed, 1e-12 + 6e-6 * std::abs(printed)) << what;
}

TEST_P(WriteFile, moves_like_the_existing_program) {
  const test::TemporaryDirectory directory;
  const std::string name = directory / "take.trk";
  std::vector<std::string> command{program("write_file"), name};
  command.insert(command.end(), GetParam().words.begin(), GetParam().words.end());
  test::Program writer(command);
  EXPECT_EQ(writer.rest_of_err(), "");
  ASSERT_EQ(writer.wait(), 0);

  const auto got = file::read_take(name);
  const auto field = file::read_take(test::data_path("field/takes/" + GetParam().name));
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

/// The output of the document's programs for the first set of each take.
TEST(ReadFile, prints_the_blocks_that_scripts_read) {
  test::Program reader({program("read_file"), test::data_path("field/takes/euler.trk")});
  const std::string out = reader.rest_of_out();
  const std::string expected =
      "Camera constants:\n"
      "\timage width:        720\n"
      "\timage height:       576\n"
      "\tblank left:         10\n"
      "\tblank right:        10\n"
      "\tblank top:          0\n"
      "\tblank bottom:       0\n"
      "\tchip width:         6.4\n"
      "\tchip height:        4.8\n"
      "\tfake chip width:    6.58286\n"
      "\tfake chip height:   4.8\n"
      "\n"
      "Camera parameters:\n"
      "\tformat:           euler studio_z_up image_distance consider_blank shift_on_chip\n"
      "\tx:                0\n"
      "\ty:                -2\n"
      "\tz:                1.5\n"
      "\tpan:              0\n"
      "\ttilt:             0\n"
      "\troll:             0\n"
      "\tfield of view:    7.72548\n"
      "\tcenter shift x:   0\n"
      "\tcenter shift y:   0\n"
      "\tdistorsion k1:    0\n"
      "\tdistorsion k2:    0\n"
      "\tfocal distance:   0\n"
      "\taperture:         0\n"
      "\tcounter:          1\n"
      "\n";
  EXPECT_EQ(out.substr(0, expected.size()), expected);
  EXPECT_THAT(out, EndsWith("\tcounter:          2259\n\n"));
  EXPECT_EQ(reader.rest_of_err(), "Time code: 03:13:51:00:1\n");
  EXPECT_EQ(reader.wait(), 0);
}

TEST(ReadFile, prints_matrices_in_rows) {
  const test::TemporaryDirectory directory;
  const std::string name = directory / "take.trk";
  std::ofstream(name) << "DMC01\n00:00:00:00:1\n720 576 10 10 0 0 6.4 4.8 6.4 4.8\n"
                         "I7 0 1 0 0 0 0.5 0 0 0 1 10 20 30.25 7.5 0 0 0 0 0 0 9\n";
  test::Program reader({program("read_file"), name});
  EXPECT_THAT(reader.rest_of_out(),
              HasSubstr("\tformat:           matrix camera_to_studio camera_z_up studio_z_up image_distance "
                        "consider_blank shift_on_chip\n"
                        "\tmatrix:\n"
                        "\t\t             1             0             0            10\n"
                        "\t\t             0           0.5             0            20\n"
                        "\t\t             0             0             1         30.25\n"
                        "\t\t             0             0             0             1\n"
                        "\tfield of view:    7.5\n"));
  EXPECT_EQ(reader.wait(), 0);
}

/// Reads until parameters are received, then ends both cleanly.
void expect_transfer(test::Program& writer, test::Program& reader) {
  bool constants = false, params = false;
  for (int i = 0; i < 100 && !(constants && params); ++i) {
    const auto line = reader.out_line();
    ASSERT_TRUE(line) << reader.rest_of_err();
    constants = constants || *line == "\timage width:        720";
    params = params || line->rfind("\tcounter:          ", 0) == 0;
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
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{}, {"euler"}, {"binary"}, {"binary", "euler"}}) {
    const test::ReservedPort port;
    test::Program reader({program("read_net"), port.text()});
    std::vector<std::string> command{program("write_net"), "127.0.0.1", port.text()};
    command.insert(command.end(), words.begin(), words.end());
    test::Program writer(command);
    expect_transfer(writer, reader);
  }
}

TEST(Net, without_parameters_it_reports_that) {
  const test::ReservedPort port;
  test::Program reader({program("read_net"), port.text()});
  EXPECT_EQ(reader.out_line(), "No new camera parameters.");
  EXPECT_EQ(reader.out_line(), "");
  reader.signal(SIGTERM);
  EXPECT_EQ(reader.wait(), 0);
}

constexpr std::pair<const char*, const char*> usages[] = {
    {"read_mem", "Usage: read_mem SLOT\n"},   {"write_mem", "Usage: write_mem SLOT [WORDS]\n"},
    {"read_net", "Usage: read_net PORT\n"},   {"write_net", "Usage: write_net HOST PORT [binary] [WORDS]\n"},
    {"read_file", "Usage: read_file FILE\n"}, {"write_file", "Usage: write_file FILE [WORDS]\n"}};

TEST(Usage, no_arguments_bring_up_what_is_required) {
  for (const auto& [name, expected] : usages) {
    test::Program usage({program(name)});
    EXPECT_THAT(usage.rest_of_err(), StartsWith(expected)) << name;
    EXPECT_EQ(usage.rest_of_out(), "");
    EXPECT_EQ(usage.wait(), 1) << name;
  }
}

TEST(Usage, help_is_no_error) {
  for (const auto& [name, expected] : usages) {
    for (const char* const word : {"--help", "-h"}) {
      test::Program help({program(name), word});
      EXPECT_THAT(help.rest_of_out(), StartsWith(expected)) << name;
      EXPECT_EQ(help.rest_of_err(), "");
      EXPECT_EQ(help.wait(), 0) << name;
    }
  }
}

TEST(Usage, bad_arguments_are_named) {
  const test::TemporaryDirectory directory;
  const std::pair<std::vector<std::string>, const char*> wrong[] = {
      {{"write_file", directory / "x.trk", "upside_down"}, "upside_down"},
      {{"read_mem", "62"}, "read_mem: slot 62: Operation failed !"},
      {{"read_mem", "seven"}, "read_mem: slot 'seven': must be a whole number"},
      {{"read_net", "70000"}, "read_net: port 70000: Operation failed !"},
      {{"read_file", directory / "none.trk"}, "none.trk: Operation failed !"},
  };
  for (const auto& [arguments, expected] : wrong) {
    std::vector<std::string> command = arguments;
    command[0] = program(command[0]);
    test::Program bad(command);
    EXPECT_THAT(bad.rest_of_err(), HasSubstr(expected));
    EXPECT_EQ(bad.wait(), 1) << expected;
  }
}

}  // namespace trk_bridge::programs::programs_test
