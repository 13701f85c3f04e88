// trk bag as its users run it.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "temporary_directory.h"
#include "vectors.h"

namespace trk_bridge::bag {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class BagCommandTest : public testing::Test {
 protected:
  int run(std::vector<std::string> words) {
    words.insert(words.begin(), {TRK_TOOL, "bag"});
    test::Program program(words);
    err_text = program.rest_of_err();
    program.rest_of_out();
    return program.wait();
  }

  test::TemporaryDirectory directory;
  const std::string take = test::data_path("field/takes/euler.trk");
  const std::string bag = directory / "take.bag";
  std::string err_text;
};

TEST_F(BagCommandTest, GoesBothWays) {
  EXPECT_EQ(run({take, bag, "--camera", "crane1", "--date", "2026-11-22"}), 0) << err_text;
  EXPECT_THAT(err_text, HasSubstr("2259 fields of camera crane1"));
  EXPECT_EQ(run({bag, directory / "back.trk"}), 0) << err_text;
  EXPECT_THAT(err_text, HasSubstr("2259 fields of /crane1/params, from 03:13:51:00:1 at 50 fields a second"));
  EXPECT_THAT(test::read_text(directory / "back.trk"), StartsWith("DMC01\n"));
}

TEST_F(BagCommandTest, ExistingTargetsNeedOverwrite) {
  test::write_text(bag, "precious");
  EXPECT_EQ(run({take, bag}), 1);
  EXPECT_THAT(err_text, HasSubstr("--overwrite"));
  EXPECT_EQ(test::read_text(bag), "precious");
  EXPECT_EQ(run({take, bag, "--overwrite"}), 0) << err_text;
  test::write_text(directory / "back.trk", "precious");
  EXPECT_EQ(run({bag, directory / "back.trk"}), 1);
  EXPECT_THAT(err_text, HasSubstr("back.trk: cannot be written: it exists"));
  EXPECT_EQ(test::read_text(directory / "back.trk"), "precious");
}

TEST_F(BagCommandTest, WrongOptionsAreUsageErrors) {
  EXPECT_EQ(run({take, bag, "--input", "tf"}), 2);
  EXPECT_THAT(err_text, HasSubstr("--input is only for making a take of a bag"));
  EXPECT_EQ(run({take, bag, "--date", "yesterday"}), 2);
  EXPECT_THAT(err_text, HasSubstr("\"yesterday\" is no date: YYYY-MM-DD"));
  EXPECT_EQ(run({take, bag, "--start", "now"}), 2);
  EXPECT_EQ(run({take, bag, "--field-rate", "0"}), 2);
  EXPECT_EQ(run({take, bag, "--format", "upside_down"}), 2);
  EXPECT_THAT(err_text, AllOf(HasSubstr("--format"), HasSubstr("upside_down"), HasSubstr("as_received")));
  EXPECT_EQ(run({take, directory / "other.trk"}), 2);
  EXPECT_THAT(err_text, HasSubstr("the name of a bag ends in .bag"));
  EXPECT_EQ(run({bag, directory / "other.bag"}), 2);
  EXPECT_EQ(run({bag, directory / "other.trk", "--start", "5"}), 2);
}

TEST_F(BagCommandTest, WhatCannotBeReadIsNamed) {
  EXPECT_EQ(run({directory / "none.trk", bag}), 1);
  EXPECT_THAT(err_text, HasSubstr("none.trk"));
  EXPECT_EQ(run({directory / "none.bag", directory / "x.trk"}), 1);
  EXPECT_THAT(err_text, HasSubstr("No such file"));
}

}  // namespace
}  // namespace trk_bridge::bag
