#include "file/part_file.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "error_of.h"
#include "temporary_directory.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::file {
namespace {

using std::filesystem::exists;
using test::read_text;
using test::write_text;
using testing::HasSubstr;
using transport::TransportError;

class PartFileTest : public testing::Test {
 protected:
  static void fill(const PartFile& file, const std::string& text) {
    ASSERT_EQ(::write(file.fd(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string opening_error(bool overwrite = false) const {
    return test::error_of<TransportError>([&] { const PartFile file(path, overwrite); });
  }

  test::TemporaryDirectory directory;
  const std::string path = directory / "some.bag";
  const std::string part = path + ".part";
};

TEST_F(PartFileTest, HasItsFinalNameOnlyWhenPublished) {
  PartFile file(path, false);
  fill(file, "whole");
  EXPECT_FALSE(exists(path));
  ASSERT_TRUE(file.publish());
  EXPECT_EQ(read_text(path), "whole");
  EXPECT_FALSE(exists(part));
  EXPECT_FALSE(file.is_open());
  EXPECT_FALSE(file.publish()) << "there is nothing more to publish";
}

TEST_F(PartFileTest, IsCutToTheSizeThatIsWhole) {
  PartFile file(path, false);
  fill(file, "whole and half");
  ASSERT_TRUE(file.publish(5));
  EXPECT_EQ(read_text(path), "whole");
}

TEST_F(PartFileTest, NothingStaysOfWhatIsDiscarded) {
  PartFile file(path, false);
  fill(file, "half");
  file.discard();
  EXPECT_FALSE(exists(path));
  EXPECT_FALSE(exists(part));
  file.discard();
}

TEST_F(PartFileTest, WhatWasNeitherPublishedNorDiscardedStaysAsThePart) {
  {
    const PartFile file(path, false);
    fill(file, "half");
    EXPECT_THAT(opening_error(true), HasSubstr("another writer"));
  }
  EXPECT_EQ(read_text(part), "half");
  EXPECT_THAT(opening_error(), HasSubstr("interrupted writer"));
  EXPECT_EQ(opening_error(true), "no error");
  EXPECT_EQ(read_text(part), "");
}

TEST_F(PartFileTest, OverwritingHasToBeAskedFor) {
  write_text(path, "precious");
  EXPECT_THAT(opening_error(), HasSubstr(path + ": cannot be written: it exists"));
  PartFile file(path, true);
  fill(file, "new");
  EXPECT_EQ(read_text(path), "precious");
  ASSERT_TRUE(file.publish());
  EXPECT_EQ(read_text(path), "new");
}

TEST_F(PartFileTest, AFileThatAppearedMeanwhileIsNotReplaced) {
  PartFile file(path, false);
  fill(file, "late");
  write_text(path, "early");
  const auto published = file.publish();
  ASSERT_FALSE(published);
  EXPECT_EQ(published.error(), EEXIST);
  EXPECT_EQ(read_text(path), "early");
  EXPECT_EQ(read_text(part), "late");
}

}  // namespace
}  // namespace trk_bridge::file
