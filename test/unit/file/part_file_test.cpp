// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "file/part_file.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "temporary_directory.h"

namespace trk_bridge::file::part_file_test {

using std::filesystem::exists;
using test::read_text;
using test::write_text;
using transport::SinkReason;

class PartFileTest : public testing::Test {
 protected:
  static void fill(const PartFile& file, const std::string& text) {
    ASSERT_EQ(::write(file.fd(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  static PartFile opened(const std::string& path, const PartFile::Options& options = {}) {
    auto file = PartFile::open(path, options);
    if (!file) throw std::runtime_error(path + ": " + transport::describe(file.error()));
    return *std::move(file);
  }
  /// None if it can be opened.
  std::optional<SinkReason> refusal(const PartFile::Options& options = {}) const {
    const auto file = PartFile::open(path, options);
    return file ? std::nullopt : std::optional(file.error().reason);
  }

  test::TemporaryDirectory directory;
  const std::string path = directory / "some.bag";
  const std::string part = path + ".part";
};

TEST_F(PartFileTest, HasItsFinalNameOnlyWhenPublished) {
  auto file = opened(path);
  fill(file, "whole");
  EXPECT_FALSE(exists(path));
  ASSERT_TRUE(file.publish());
  EXPECT_EQ(read_text(path), "whole");
  EXPECT_FALSE(exists(part));
  EXPECT_FALSE(file.is_open());
  EXPECT_FALSE(file.publish()) << "there is nothing more to publish";
}

TEST_F(PartFileTest, IsTruncatedToItsCompleteSize) {
  auto file = opened(path);
  fill(file, "whole and half");
  ASSERT_TRUE(file.publish(5));
  EXPECT_EQ(read_text(path), "whole");
}

TEST_F(PartFileTest, ADiscardedFileIsRemoved) {
  auto file = opened(path);
  fill(file, "half");
  file.discard();
  EXPECT_FALSE(exists(path));
  EXPECT_FALSE(exists(part));
  file.discard();
}

TEST_F(PartFileTest, AFileThatIsNeitherPublishedNorDiscardedStaysAsPart) {
  {
    const auto file = opened(path);
    fill(file, "half");
    EXPECT_EQ(refusal({true}), SinkReason::in_use);
  }
  EXPECT_EQ(read_text(part), "half");
  EXPECT_EQ(refusal(), SinkReason::part_exists);
  EXPECT_EQ(refusal({true}), std::nullopt);
  EXPECT_EQ(read_text(part), "");
}

TEST_F(PartFileTest, OverwritingMustBeRequested) {
  write_text(path, "precious");
  EXPECT_EQ(refusal(), SinkReason::exists);
  auto file = opened(path, {true});
  fill(file, "new");
  EXPECT_EQ(read_text(path), "precious");
  ASSERT_TRUE(file.publish());
  EXPECT_EQ(read_text(path), "new");
}

TEST_F(PartFileTest, AFileThatAppearedMeanwhileIsNotReplaced) {
  auto file = opened(path);
  fill(file, "late");
  write_text(path, "early");
  const auto published = file.publish();
  ASSERT_FALSE(published);
  EXPECT_EQ(published.error(), EEXIST);
  EXPECT_EQ(read_text(path), "early");
  EXPECT_EQ(read_text(part), "late");
}

TEST_F(PartFileTest, AUniqueNameMustNotExist) {
  PartFile::Options options;
  options.part = Part::refused;
  {
    const auto file = opened(path, options);
    EXPECT_EQ(refusal(options), SinkReason::in_use);
  }
  EXPECT_EQ(refusal(options), SinkReason::in_use) << "it exists, although no process writes it";
}

TEST_F(PartFileTest, OtherThanFilesAreRefusedAndUnchanged) {
  for (const bool overwrite : {false, true}) {
    for (const std::string& other : {directory.path(), std::string("/dev/null")}) {
      const auto file = PartFile::open(other, {overwrite, Fifo::allowed});
      ASSERT_FALSE(file) << other;
      EXPECT_EQ(file.error().reason, SinkReason::not_a_file);
      EXPECT_FALSE(exists(other + ".part"));
    }
  }
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(refusal({true}), SinkReason::not_a_file) << "FIFOs must be allowed";
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  std::filesystem::remove(path);
  ASSERT_EQ(::mkfifo(part.c_str(), 0600), 0);
  EXPECT_EQ(refusal({true}), SinkReason::not_a_file) << "without waiting for a reader";
}

TEST_F(PartFileTest, AFifoIsWrittenDirectlyOnceItHasAReader) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const PartFile::Options options{false, Fifo::allowed};
  EXPECT_EQ(refusal(options), SinkReason::no_reader);
  const transport::Descriptor reader(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  auto file = opened(path, options);
  EXPECT_TRUE(file.is_fifo());
  fill(file, "whole");
  ASSERT_TRUE(file.publish());
  char read[8] = {};
  EXPECT_EQ(::read(reader.get(), read, sizeof read), 5);
  EXPECT_STREQ(read, "whole");
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_FALSE(exists(part));
}

/// The file after an interrupted writer.
class RecoverPart : public PartFileTest {
 protected:
  const std::string take = directory / "crane.trk";
  const std::string left = take + ".part";
  const std::string head = "DMC01\n# time code\n10:20:30:12:1\n# constants\n720 576 0 0 0 0 8.8 6.6 8.8 6.6\n";
};

TEST_F(RecoverPart, CompleteLinesAreKeptInTheRecoveredFile) {
  write_text(left, head + "1 a field\n2 another\n3 half a");
  EXPECT_EQ(recover_part(left), directory / "crane.recovered.trk");
  EXPECT_EQ(read_text(directory / "crane.recovered.trk"), head + "1 a field\n2 another\n");
  EXPECT_FALSE(exists(left));
}

TEST_F(RecoverPart, NothingIsReplaced) {
  write_text(directory / "crane.recovered.trk", "precious");
  write_text(directory / "crane.recovered-2.trk", "precious");
  write_text(left, head + "1\n");
  EXPECT_EQ(recover_part(left), directory / "crane.recovered-3.trk");
  EXPECT_EQ(read_text(directory / "crane.recovered.trk"), "precious");
}

TEST_F(RecoverPart, ALongIncompleteLastLineIsRemovedToo) {
  write_text(left, head + "1\n" + std::string(100'000, 'x'));
  ASSERT_TRUE(recover_part(left));
  EXPECT_EQ(read_text(directory / "crane.recovered.trk"), head + "1\n");
}

TEST_F(RecoverPart, WithoutAFieldThereIsNothingToKeep) {
  for (const auto& text : {std::string("DMC01\n"), head, head + "1 not whole"}) {
    write_text(left, text);
    EXPECT_EQ(recover_part(left), std::nullopt);
    EXPECT_FALSE(exists(left)) << text;
  }
}

TEST_F(RecoverPart, OtherFilesAndThoseWithAWriterAreUnchanged) {
  write_text(left, "somebody's own\n1\n2\n3\n4\n");
  EXPECT_EQ(recover_part(left), std::nullopt);
  EXPECT_EQ(read_text(left), "somebody's own\n1\n2\n3\n4\n");
  std::filesystem::remove(left);
  const auto file = opened(take);
  fill(file, head + "1\n");
  EXPECT_EQ(recover_part(left), std::nullopt);
  EXPECT_EQ(read_text(left), head + "1\n");
  EXPECT_EQ(recover_part(directory / "absent.part"), std::nullopt);
}

TEST_F(RecoverPart, NamesWithoutAnEndingAndInDirectoriesWithADot) {
  std::filesystem::create_directory(directory / "day.1");
  for (const auto& [name, recovered] :
       std::vector<std::pair<std::string, std::string>>{{"day.1/crane", "day.1/crane.recovered"},
                                                        {".crane", ".crane.recovered"},
                                                        {"a.b.trk", "a.b.recovered.trk"}}) {
    write_text(directory / (name + ".part"), head + "1\n");
    EXPECT_EQ(recover_part(directory / (name + ".part")), directory / recovered);
  }
}

}  // namespace trk_bridge::file::part_file_test
