// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// One motion in three formats is one camera.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "temporary_directory.h"
#include "trk_bridge/camera/camera.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::takes_test {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

camera::Camera camera_of(const file::Take& take, std::size_t field) {
  const auto decoded = camera::decode(take.params.at(field), &take.constants);
  if (!decoded) throw std::runtime_error("field " + std::to_string(field) + ": " + camera::describe(decoded.error()));
  return *decoded;
}

TEST(Takes, ThreeFormatsAreOneCamera) {
  const auto read = [](const std::string& name) {
    return file::read_take(test::data_path("field/takes/" + name + ".trk"));
  };
  const auto plain = read("euler");
  const auto angles = read("euler-ignore_blank-keep_aspect-field_of_view-vertical");
  const auto matrix = read("matrix-studio_to_camera-camera_y_up-studio_y_up");
  ASSERT_EQ(plain.params.size(), 2259u);
  for (const auto* other : {&angles, &matrix}) {
    ASSERT_EQ(other->params.size(), plain.params.size());
    for (std::size_t i = 0; i < plain.params.size(); ++i) {
      const camera::Camera expected = camera_of(plain, i), found = camera_of(*other, i);
      ASSERT_EQ(other->params[i].counter, plain.params[i].counter);
      // Six digits of metres up to 10, of angles up to 360 degrees, of millimetres.
      EXPECT_LT((expected.pose.translation() - found.pose.translation()).norm(), 2e-4) << i;
      EXPECT_LT((expected.pose.linear() - found.pose.linear()).norm(), 2e-5) << i;
      EXPECT_NEAR(found.lens.image_distance / expected.lens.image_distance, 1.0, 2e-5) << i;
      EXPECT_LT((expected.lens.center_shift - found.lens.center_shift).norm(), 2e-5) << i;
    }
  }
}

/// A program's standard error and exit code.
struct Outcome {
  std::string err;
  int exit_code;
};

/// Of the programs that read a take to its end; `trk relay` writes `copy`.
std::vector<Outcome> dump_and_relay(const std::string& take, const std::string& copy) {
  const std::string source = "file:" + take + "?speed=0";
  std::vector<Outcome> outcomes;
  for (const auto& command :
       std::vector<std::vector<std::string>>{{TRK_TOOL, "dump", source}, {TRK_TOOL, "relay", source, "file:" + copy}}) {
    test::Program program(command);
    program.rest_of_out();
    const std::string err = program.rest_of_err();
    outcomes.push_back({err, program.wait()});
  }
  return outcomes;
}

TEST(Takes, ATruncatedTakeIsUsedToItsLastCompleteLineWithAWarning) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "cut.trk", copy = directory / "copy.trk";
  const std::string original = test::data_path("field/takes/euler.trk");
  const std::string text = test::read_text(original);
  test::write_text(path, text.substr(0, text.size() - 30));
  const std::size_t fields = file::read_take(original).params.size() - 1;
  for (const auto& [err, exit_code] : dump_and_relay(path, copy)) {
    EXPECT_THAT(err, ContainsRegex("line [0-9]+ is truncated: "));
    EXPECT_THAT(err, HasSubstr("(" + std::to_string(fields) + " parameters, 1 constants), malformed 1"));
    EXPECT_EQ(exit_code, 0) << err;
  }
  EXPECT_EQ(file::read_take(copy).params.size(), fields);
}

TEST(Takes, AMalformedLineIsAnErrorThatNamesItAnywhere) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "bad.trk", copy = directory / "copy.trk";
  std::string text = test::read_text(test::data_path("field/takes/euler.trk"));
  // Line 2000, of 2262 and some comments.
  std::size_t at = 0;
  for (int line = 1; line < 2000; ++line) at = text.find('\n', at) + 1;
  test::write_text(path, text.insert(at, "oops "));
  for (const auto& [err, exit_code] : dump_and_relay(path, copy)) {
    EXPECT_THAT(err, HasSubstr("trk: error: " + path + ":2000: field 1 is not"));
    EXPECT_EQ(exit_code, 1) << err;
  }
}

}  // namespace trk_bridge::takes_test
