#include "file/take.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "temporary_directory.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"

namespace trk_bridge::file {
namespace {

using test::data_path;
using test::TemporaryDirectory;
using test::write_text;
using testing::HasSubstr;
using testing::StartsWith;
using transport::TransportError;

const char* const head = "DMC01\n10:20:30:12:1\n1920 1080 14 2 12 4 27.0053 18.509 27.2322 18.7873\n";
const char* const line = "1 14.5 -4 15 158 -78 137 53.5 0.1 0.05 -0.001 -7e-06 16.5 8 1000\n";

std::string error_of(const std::string& path) {
  return test::error_of<TransportError>([&] { static_cast<void>(read_take(path)); });
}

class ReadTake : public testing::Test {
 protected:
  std::string error_of_text(const std::string& text) {
    write_text(path, text);
    return error_of(path);
  }
  TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
};

TEST_F(ReadTake, TheFieldsFilesOf500Sets) {
  for (const std::string abi : {"document_i386", "document_lp64", "identified_i386", "identified_lp64"}) {
    const Take take = read_take(data_path("field/" + abi + "/ref500.trk"));
    EXPECT_EQ(take.params.size(), 500u) << abi;
    EXPECT_EQ(to_string(take.time_code), "10:20:30:12:1") << abi;
    EXPECT_EQ(take.constants.image_width, 1920) << abi;
    EXPECT_EQ(take.constants.fake_chip_height, 18.7873) << abi;
    EXPECT_EQ(take.params.front().counter, 1000u) << abi;
    EXPECT_EQ(take.params.back().counter, 1499u) << abi;
    EXPECT_EQ(take.params.front().euler.pan, 158.967) << abi;
  }
}

TEST_F(ReadTake, TheFieldsTakesInThreeFormats) {
  for (const auto& [name, format] : std::vector<std::pair<std::string, std::uint32_t>>{
           {"euler", wire::euler},
           {"euler-ignore_blank-keep_aspect-field_of_view-vertical",
            wire::euler | wire::ignore_blank | wire::keep_aspect | wire::field_of_view | wire::vertical},
           {"matrix-studio_to_camera-camera_y_up-studio_y_up",
            wire::studio_to_camera | wire::camera_y_up | wire::studio_y_up}}) {
    const Take take = read_take(data_path("field/takes/" + name + ".trk"));
    EXPECT_EQ(take.params.size(), 2259u) << name;
    EXPECT_EQ(to_string(take.time_code), "03:13:51:00:1") << name;
    for (const auto& params : take.params) ASSERT_EQ(params.format, format) << name;
  }
}

TEST_F(ReadTake, AnIdInALineIsKept) {
  write_text(path,
             "DMC01\n10:20:30:12:1\nI7 1920 1080 14 2 12 4 27.0053 18.509 27.2322 18.7873\nI7 " + std::string(line));
  const Take take = read_take(path);
  EXPECT_EQ(take.constants.id, 7u);
  EXPECT_EQ(take.params.at(0).id, 7u);
}

TEST_F(ReadTake, CarriageReturnsCommentsAndBlankLinesCountForNothing) {
  write_text(path, "\r\n  # one\r\nDMC01\r\n\r\n10:20:30:12:1\r\n#\r\n1920 1080 14 2 12 4 27 18 27 18\r\n\t\r\n" +
                       std::string("1 14.5 -4 15 158 -78 137 53.5 0.1 0.05 -0.001 -7e-06 16.5 8 1000"));
  const Take take = read_take(path);
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0].counter, 1000u);
  EXPECT_EQ(take.constants.chip_width, 27.0);
}

TEST_F(ReadTake, TheWrongLineIsNamedExactly) {
  // Three lines of head, so that the 54th set stands in line 57.
  std::string text = head;
  for (int i = 0; i < 100; ++i) text += i == 53 ? "1 14.5 -4 15 158 -78 137 53.5 oops 0 0 0 16.5 8 1000\n" : line;
  EXPECT_EQ(error_of_text(text), path + ":57: field 9 is not a number");
}

TEST_F(ReadTake, LinesAreCountedWithCommentsAndBlanks) {
  EXPECT_THAT(error_of_text("DMC01\n# a\n\n# b\nnonsense\n"), StartsWith(path + ":5: \"nonsense\" is no time code"));
}

TEST_F(ReadTake, EveryPartThatIsMissingOrWrong) {
  EXPECT_THAT(error_of_text(""), StartsWith(path + ":1: the file ends where DMC01"));
  EXPECT_THAT(error_of_text("DMC02\n"), StartsWith(path + ":1: not a take"));
  EXPECT_THAT(error_of_text("DMC01\n"), StartsWith(path + ":2: the file ends where the time code"));
  EXPECT_THAT(error_of_text("DMC01\n10:20:30:12:3\n"), StartsWith(path + ":2: \"10:20:30:12:3\""));
  EXPECT_THAT(error_of_text("DMC01\n10:20:30:12:1\n"), StartsWith(path + ":3: the file ends where the camera's const"));
  EXPECT_THAT(error_of_text("DMC01\n10:20:30:12:1\n1920 1080 x\n"), StartsWith(path + ":3: constants: field 3"));
  EXPECT_THAT(error_of_text(head + std::string("1 2 3\n")), StartsWith(path + ":4: "));
  EXPECT_THAT(error_of_text(head + std::string(line).insert(20, std::string(1, '\0'))), StartsWith(path + ":4: "));
}

TEST_F(ReadTake, ALineOf4096BytesIsTooLongAndOneByteLessIsNot) {
  EXPECT_THAT(error_of_text(head + std::string("#") + std::string(4095, 'x') + "\n"),
              HasSubstr(path + ":4: a line of 4096 bytes"));
  write_text(path, head + std::string("#") + std::string(4094, 'x') + "\n" + line);
  EXPECT_EQ(read_take(path).params.size(), 1u);
}

TEST_F(ReadTake, WhatCannotBeReadSaysWhy) {
  EXPECT_EQ(error_of(directory / "absent.trk"),
            directory / "absent.trk" + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of(directory.path()), directory.path() + ": cannot be read: Is a directory");
}

TEST_F(ReadTake, ATakeThatEndedBeforeItsFirstFieldIsOne) {
  write_text(path, head);
  EXPECT_TRUE(read_take(path).params.empty());
}

}  // namespace
}  // namespace trk_bridge::file
