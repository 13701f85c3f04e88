// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// trk bag, run like a user does.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "temporary_directory.h"
#include "vectors.h"

namespace trk_bridge::bag::command_test {

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

TEST_F(BagCommandTest, ConvertsInBothDirections) {
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

/// On a small private file system.
class OnAFullDisk : public BagCommandTest {
 protected:
  /// Runs it where `size` bytes are free, and then lists the directory.
  int run_with_room(const std::string& size, const std::string& arguments) {
    test::Program program({"/bin/sh", "-c",
                           "exec unshare --user --map-root-user --mount /bin/sh -c 'mount -t tmpfs -o size=" + size +
                               " trk_bridge_test " + directory.path() + "; cd " + directory.path() + "; " +
                               std::string(TRK_TOOL) + " bag " + arguments + "; code=$?; ls; exit $code'"});
    err_text = program.rest_of_err();
    left = program.rest_of_out();
    return program.wait();
  }

  std::string left;
};
class BagOnAFullDisk : public OnAFullDisk, public testing::WithParamInterface<std::string> {};

TEST_P(BagOnAFullDisk, IsAnErrorAndLeavesNothing) {
  ASSERT_EQ(run_with_room("100M", take + " x.bag --compression " + GetParam()), 0) << err_text;
  ASSERT_EQ(left, "x.bag\n");
  for (const char* size : {"4k", "8k", "60k"}) {
    EXPECT_EQ(run_with_room(size, take + " x.bag --compression " + GetParam()), 1) << size;
    EXPECT_THAT(err_text, HasSubstr("trk: error: x.bag: cannot be written: No space left on device")) << size;
    EXPECT_EQ(left, "") << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Compressions, BagOnAFullDisk, testing::Values("none", "bz2", "lz4"),
                         [](const auto& test) { return test.param; });

TEST_F(OnAFullDisk, ATakeIsAnErrorAndLeavesNothing) {
  const test::TemporaryDirectory other;
  ASSERT_EQ(run({take, other / "x.bag"}), 0) << err_text;
  EXPECT_EQ(run_with_room("100k", other / "x.bag" + " x.trk"), 1);
  EXPECT_THAT(err_text, HasSubstr("x.trk: cannot be written: the system refused: No space left on device"));
  EXPECT_EQ(left, "");
}

TEST_F(BagCommandTest, AMalformedLineIsAnErrorAndLeavesNothing) {
  const std::string bad = directory / "bad.trk";
  test::write_text(bad, test::read_text(take) + "oops\n");
  const std::string text = test::read_text(bad);
  const auto lines = std::to_string(std::count(text.begin(), text.end(), '\n'));
  EXPECT_EQ(run({bad, bag}), 1);
  EXPECT_THAT(err_text, HasSubstr(bad + ":" + lines + ": field 1 is not"));
  EXPECT_FALSE(std::filesystem::exists(bag));
  EXPECT_FALSE(std::filesystem::exists(bag + ".part"));
}

TEST_F(BagCommandTest, WrongOptionsAreUsageErrors) {
  EXPECT_EQ(run({take, bag, "--input", "tf"}), 2);
  EXPECT_THAT(err_text, HasSubstr("--input is only for converting a bag to a take"));
  EXPECT_EQ(run({take, bag, "--date", "yesterday"}), 2);
  EXPECT_THAT(err_text, HasSubstr("\"yesterday\" is not a date: YYYY-MM-DD"));
  EXPECT_EQ(run({take, bag, "--start", "now"}), 2);
  EXPECT_EQ(run({take, bag, "--field-rate", "0"}), 2);
  EXPECT_EQ(run({take, bag, "--format", "upside_down"}), 2);
  EXPECT_THAT(err_text, AllOf(HasSubstr("--format"), HasSubstr("upside_down"), HasSubstr("as_received")));
  EXPECT_EQ(run({take, directory / "other.trk"}), 2);
  EXPECT_THAT(err_text, HasSubstr("the name of a bag ends in .bag"));
  EXPECT_EQ(run({bag, directory / "other.bag"}), 2);
  EXPECT_EQ(run({bag, directory / "other.trk", "--start", "5"}), 2);
}

TEST_F(BagCommandTest, FilesThatCannotBeReadAreNamed) {
  EXPECT_EQ(run({directory / "none.trk", bag}), 1);
  EXPECT_THAT(err_text, HasSubstr("none.trk"));
  EXPECT_EQ(run({directory / "none.bag", directory / "x.trk"}), 1);
  EXPECT_THAT(err_text, HasSubstr("No such file"));
}

}  // namespace trk_bridge::bag::command_test
