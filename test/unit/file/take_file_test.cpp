// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "file/take.h"

#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bytes_read.h"
#include "error_of.h"
#include "temporary_directory.h"
#include "trk_bridge/transport/source.h"
#include "trk_bridge/wire/format.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::file::take_file_test {

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

TEST_F(ReadTake, CarriageReturnsCommentsAndBlankLinesAreIgnored) {
  write_text(path, "\r\n  # one\r\nDMC01\r\n\r\n10:20:30:12:1\r\n#\r\n1920 1080 14 2 12 4 27 18 27 18\r\n\t\r\n" +
                       std::string("1 14.5 -4 15 158 -78 137 53.5 0.1 0.05 -0.001 -7e-06 16.5 8 1000"));
  const Take take = read_take(path);
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0].counter, 1000u);
  EXPECT_EQ(take.constants.chip_width, 27.0);
}

TEST_F(ReadTake, TheWrongLineIsNamedExactly) {
  // Three lines of head, so that the 54th set is in line 57.
  std::string text = head;
  for (int i = 0; i < 100; ++i) text += i == 53 ? "1 14.5 -4 15 158 -78 137 53.5 oops 0 0 0 16.5 8 1000\n" : line;
  EXPECT_EQ(error_of_text(text), path + ":57: field 9 is not a number");
}

TEST_F(ReadTake, LinesAreCountedWithCommentsAndBlanks) {
  EXPECT_THAT(error_of_text("DMC01\n# a\n\n# b\nnonsense\n"), StartsWith(path + ":5: \"nonsense\" is not a time code"));
}

TEST_F(ReadTake, EveryPartThatIsMissingOrWrong) {
  EXPECT_THAT(error_of_text(""), StartsWith(path + ":1: the file ends before DMC01"));
  EXPECT_THAT(error_of_text("DMC02\n"), StartsWith(path + ":1: not a take"));
  EXPECT_THAT(error_of_text("DMC01\n"), StartsWith(path + ":2: the file ends before the time code"));
  EXPECT_THAT(error_of_text("DMC01\n10:20:30:12:3\n"), StartsWith(path + ":2: \"10:20:30:12:3\""));
  EXPECT_THAT(error_of_text("DMC01\n10:20:30:12:1\n"),
              StartsWith(path + ":3: the file ends before the camera's const"));
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

TEST_F(ReadTake, ATruncatedLastLineIsIgnoredForAnyLength) {
  const std::string whole = head + std::string(line) + "1 14.5 -4 15 158 -78 137 53.5 0.1 0.05 -0.001 -7e-06 16.5 8 ";
  const std::string text = whole + "1001";
  const std::size_t second = (head + std::string(line)).size();
  for (std::size_t size = second; size <= text.size(); ++size) {
    write_text(path, text.substr(0, size));
    const Take take = read_take(path);
    const bool is_whole = size == text.size();
    ASSERT_EQ(take.params.size(), is_whole ? 2U : 1U) << size;
    EXPECT_EQ(take.params.back().counter, is_whole ? 1001U : 1000U) << size;
    ASSERT_EQ(take.skipped.size(), is_whole || size == second ? 0U : 1U) << size;
    if (take.skipped.empty()) continue;
    EXPECT_THAT(describe(take.skipped[0].fault), StartsWith("line 5 is truncated: "));
    EXPECT_EQ(take.skipped[0].fault.line(), 5U);
  }
  write_text(path, text.substr(0, second + 20) + std::string(100, '\0'));
  EXPECT_EQ(read_take(path).skipped.size(), 1U) << "as after a power failure";
  write_text(path, text.substr(0, second + 20) + "\n");
  EXPECT_THAT(error_of(path), StartsWith(path + ":5: ")) << "a line with a line feed is complete";
  EXPECT_THAT(error_of_text(std::string(head).substr(0, 40)), StartsWith(path + ":3: ")) << "a truncated head";
}

TEST_F(ReadTake, MalformedLinesAreSkippedIfRequested) {
  const std::string good = line, bad = "1 14.5 -4 oops 158\n", with_nul = std::string(good).insert(3, 1, '\0');
  write_text(path, head + good + bad + good + with_nul + std::string(10'000, 'x') + "\n" + good + "1 2 3");
  EXPECT_THAT(error_of(path), StartsWith(path + ":5: field 4 is not a number"));
  const Take take = read_take(path, MalformedLines::are_skipped);
  EXPECT_EQ(take.params.size(), 3U);
  std::vector<std::string> texts;
  std::vector<std::size_t> positions;
  for (const auto& [position, fault] : take.skipped) {
    texts.push_back(describe(fault));
    positions.push_back(position);
  }
  EXPECT_THAT(texts, testing::ElementsAre("line 5: field 4 is not a number", "line 7: a NUL byte in a line of text",
                                          StartsWith("line 8: a line of 4096 bytes or more"),
                                          StartsWith("line 10 is truncated: field 4 is missing")));
  EXPECT_THAT(positions, testing::ElementsAre(1, 2, 2, 3));
}

TEST_F(ReadTake, AByteOrderMarkIsSkipped) {
  write_text(path, "\xEF\xBB\xBF" + std::string(head) + line);
  EXPECT_EQ(read_take(path).params.size(), 1U);
  EXPECT_THAT(error_of_text(std::string(head) + "\xEF\xBB\xBF" + line), StartsWith(path + ":4: "))
      << "only at the start";
}

TEST_F(ReadTake, ALineWithoutEndIsReadOnlyUpToTheLimit) {
  // A sparse file of 1 GB: a reader that loads it completely needs that much memory, which is not available here.
  write_text(path, head);
  ASSERT_EQ(::truncate(path.c_str(), 1 << 30), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{200'000'000, 200'000'000};
    ::setrlimit(RLIMIT_AS, &limit);
    const std::int64_t before = test::bytes_read();
    const std::string error = error_of(path);
    const std::int64_t read = test::bytes_read() - before;
    const bool is_good = error.rfind(path + ":4: a line of 4096 bytes or more", 0) == 0;
    // The head and the line, and what was read for counting.
    ::_exit(!is_good ? 1 : read > 3 * 4096 ? 2 : 0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST_F(ReadTake, OtherThanFilesAreRefusedWithoutBeingRead) {
  EXPECT_EQ(error_of("/dev/zero"), "/dev/zero: cannot be read: it is a device; allowed are regular files and FIFOs");
}

TEST_F(ReadTake, ATakeCanBeReadAgainFromItsFirstField) {
  // Longer than any block, so that the beginning is no longer in memory.
  std::string text = "\xEF\xBB\xBF# one\n" + std::string(head) + "# two\n";
  for (int i = 0; i < 2000; ++i) text += std::string(line) + "\n";
  write_text(path, text + "1 2 3");
  TakeReader take(path, MalformedLines::are_errors, Waiting::never);
  ASSERT_EQ(take.next(), TakeReader::Got::head);
  EXPECT_EQ(take.progress(), 8192 / static_cast<double>(text.size() + 5));
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 2000; ++i) ASSERT_EQ(take.next(), TakeReader::Got::params);
    EXPECT_EQ(take.params().counter, 1000U);
    EXPECT_EQ(take.next(), TakeReader::Got::truncated);
    EXPECT_EQ(take.fault().line(), 4006U);
    EXPECT_EQ(take.next(), TakeReader::Got::end);
    EXPECT_EQ(take.progress(), 1);
    ASSERT_TRUE(take.rewind());
  }
}

TEST_F(ReadTake, AFifoIsReadToItsEnd) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { write_text(path, head + std::string(line)); });
  EXPECT_EQ(read_take(path).params.size(), 1U);
  writer.join();
}

TEST_F(ReadTake, ReportsWhyAFileCannotBeRead) {
  EXPECT_EQ(error_of(directory / "absent.trk"),
            directory / "absent.trk" + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of(directory.path()), directory.path() + ": cannot be read: Is a directory");
}

TEST_F(ReadTake, ATakeWithoutFieldsIsValid) {
  write_text(path, head);
  EXPECT_TRUE(read_take(path).params.empty());
}

}  // namespace trk_bridge::file::take_file_test
