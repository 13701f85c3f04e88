// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "error_of.h"
#include "file/take_writer.h"
#include "temporary_directory.h"
#include "trk_bridge/transport/source.h"
#include "vectors.h"
#include "whole_take.h"

namespace trk_bridge::file::take_writer_test {

using std::filesystem::exists;
using test::read_text;
using test::write_text;
using testing::HasSubstr;
using transport::SinkReason;
using transport::TransportError;

constexpr base::TimeCode code{3, 13, 51, 0, 1};

wire::CameraConstants some_constants() {
  return test::constants_of(test::read_jsonl("field/document_lp64/constants.jsonl")[0]["fields"]);
}

wire::CameraParams some_params(std::uint64_t counter) {
  wire::CameraParams p;
  p.format = 1;
  p.euler = {1, 2, 3, 179.99999, 5, 6};
  p.fov = 1.0 / 3.0;
  p.counter = counter;
  return p;
}

class WriteTake : public testing::Test {
 protected:
  std::string opening_error(bool overwrite = false) {
    return test::error_of<TransportError>([&] { const TakeWriter writer(path, code, overwrite); });
  }

  test::TemporaryDirectory directory;
  const std::string path = directory / "take.trk";
  const std::string part = path + ".part";
};

TEST_F(WriteTake, EveryDoubleReadsBackToTheLastBit) {
  std::vector<wire::CameraParams> written;
  const auto constants = some_constants();
  {
    TakeWriter writer(path, code, false);
    ASSERT_TRUE(writer.write(constants));
    for (const auto& line : test::read_jsonl("field/identified_lp64/params.jsonl")) {
      written.push_back(test::params_of(line["fields"]));
      written.back().id = constants.id;
      // The bottom row is no part of the text.
      if ((written.back().format & 1) == 0) {
        for (std::size_t j = 0; j < 4; ++j) written.back().matrix[4 * j + 3] = j == 3 ? 1 : 0;
      }
      ASSERT_TRUE(writer.write(written.back()));
    }
    ASSERT_TRUE(writer.close());
  }
  const Take take = read_take(path);
  EXPECT_EQ(take.time_code, code);
  EXPECT_EQ(take.constants, constants);
  ASSERT_EQ(take.params.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_EQ(take.params[i], written[i]) << i;
}

TEST_F(WriteTake, TheFinalNameAppearsOnlyAtClose) {
  TakeWriter writer(path, code, false);
  ASSERT_TRUE(writer.write(some_constants()));
  ASSERT_TRUE(writer.write(some_params(1)));
  EXPECT_FALSE(exists(path));
  EXPECT_TRUE(exists(part));
  ASSERT_TRUE(writer.close());
  EXPECT_TRUE(exists(path));
  EXPECT_FALSE(exists(part));
  EXPECT_TRUE(writer.close()) << "closing again does nothing";
  EXPECT_EQ(writer.write(some_params(2)).error().reason, SinkReason::closed);
  EXPECT_EQ(writer.write(some_constants()).error().reason, SinkReason::closed);
}

TEST_F(WriteTake, AWriterThatCrashesLeavesItsFieldsInThePartOnly) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    TakeWriter writer(path, code, false);
    const bool good = writer.write(some_constants()) && writer.write(some_params(1)) && writer.write(some_params(2));
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_FALSE(exists(path));
  EXPECT_EQ(read_take(part).params.size(), 2u);
  EXPECT_EQ(opening_error(), "no error") << "the name can be used at once";
  EXPECT_EQ(read_take(directory / "take.recovered.trk").params.size(), 2u);
}

TEST_F(WriteTake, OverwritingMustBeRequested) {
  write_text(path, "precious");
  EXPECT_THAT(opening_error(), HasSubstr(path));
  EXPECT_THAT(opening_error(), HasSubstr("overwrite=1"));
  EXPECT_EQ(read_text(path), "precious");
  EXPECT_FALSE(exists(part));

  TakeWriter writer(path, code, true);
  ASSERT_TRUE(writer.write(some_constants()));
  EXPECT_EQ(read_text(path), "precious") << "until the new one is complete";
  ASSERT_TRUE(writer.close());
  EXPECT_TRUE(read_take(path).params.empty());
}

TEST_F(WriteTake, AFileThatAppearedWhileWritingIsNotOverwritten) {
  TakeWriter writer(path, code, false);
  ASSERT_TRUE(writer.write(some_constants()));
  write_text(path, "precious");
  const auto closed = writer.close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().reason, SinkReason::system);
  EXPECT_EQ(closed.error().error_number, EEXIST);
  EXPECT_EQ(read_text(path), "precious");
  EXPECT_TRUE(exists(part));
}

TEST_F(WriteTake, UntilTheFirstFieldTimeCodeAndConstantsMayChange) {
  TakeWriter writer(path, code, false);
  auto constants = some_constants();
  ASSERT_TRUE(writer.write(constants));
  constants.blank_left += 1;
  ASSERT_TRUE(writer.write(constants));
  const base::TimeCode later{10, 20, 30, 12, 2};
  writer.set_time_code(later);
  ASSERT_TRUE(writer.write(some_params(1)));
  writer.set_time_code(code);
  ASSERT_TRUE(writer.close());
  const Take take = read_take(path);
  EXPECT_EQ(take.constants, constants);
  EXPECT_EQ(take.time_code, later);
}

TEST_F(WriteTake, EveryLineIsInTheFileWhenItIsWritten) {
  TakeWriter writer(path, code, false);
  ASSERT_TRUE(writer.write(some_constants()));
  for (std::uint64_t counter = 1; counter <= 3; ++counter) {
    ASSERT_TRUE(writer.write(some_params(counter)));
    EXPECT_EQ(read_take(part).params.size(), counter);
  }
}

TEST_F(WriteTake, AFifoThatLosesItsReaderIsClosedAndBeginsAgain) {
  struct NoSignal {
    NoSignal() : before(std::signal(SIGPIPE, SIG_IGN)) {}
    ~NoSignal() { std::signal(SIGPIPE, before); }
    void (*before)(int);
  } no_signal;
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const auto open_reader = [this] { return transport::Descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK)); };
  const auto text_of = [](const transport::Descriptor& reader) {
    std::string text(65536, ' ');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(reader.get(), text.data(), text.size()))));
    return text;
  };
  TakeWriter writer;
  ASSERT_TRUE(writer.write(some_constants()));
  EXPECT_EQ(open_take(path, false).error().reason, SinkReason::no_reader);
  auto reader = open_reader();
  ASSERT_TRUE(writer.open(open_take(path, false).value()));
  ASSERT_TRUE(writer.write(some_params(1)));
  const std::string first = text_of(reader);
  EXPECT_THAT(first, testing::StartsWith("DMC01\n"));
  reader.close();
  EXPECT_EQ(writer.write(some_params(2)).error().reason, SinkReason::no_reader);
  EXPECT_FALSE(writer.is_open());
  reader = open_reader();
  ASSERT_TRUE(writer.open(open_take(path, false).value()));
  ASSERT_TRUE(writer.write(some_params(1)));
  EXPECT_EQ(text_of(reader), first) << "from the beginning";
  EXPECT_TRUE(writer.close());
}

TEST_F(WriteTake, OnlyOneWriterAtATime) {
  TakeWriter writer(path, code, false);
  EXPECT_THAT(opening_error(), HasSubstr("another writer is writing"));
  EXPECT_THAT(opening_error(true), HasSubstr("another writer is writing"));
}

TEST_F(WriteTake, ConstantsComeFirstAndCannotChange) {
  TakeWriter writer(path, code, false);
  EXPECT_EQ(writer.write(some_params(1)).error().reason, SinkReason::no_constants);
  const auto constants = some_constants();
  ASSERT_TRUE(writer.write(constants));
  EXPECT_TRUE(writer.write(constants)) << "the same again is no change";
  EXPECT_TRUE(writer.write(some_params(2)));

  auto others = constants;
  others.blank_left += 1;
  EXPECT_EQ(writer.write(others).error().reason, SinkReason::constants_changed);
  EXPECT_EQ(writer.write(some_params(3)).error().reason, SinkReason::constants_changed) << "they belong to the others";
  EXPECT_TRUE(writer.write(constants));
  EXPECT_TRUE(writer.write(some_params(4)));
  ASSERT_TRUE(writer.close());
  const Take take = read_take(path);
  EXPECT_EQ(take.constants, constants);
  ASSERT_EQ(take.params.size(), 2u);
  EXPECT_EQ(take.params[1].counter, 4u);
}

TEST_F(WriteTake, AFileContainsOneCamera) {
  TakeWriter writer(path, code, false);
  auto constants = some_constants();
  auto params = some_params(1);
  constants.id = params.id = 3;
  ASSERT_TRUE(writer.write(constants));
  constants.id = 5;
  EXPECT_EQ(writer.write(constants).error().reason, SinkReason::other_camera);
  EXPECT_TRUE(writer.write(params)) << "the constants of another camera change nothing";
  params.id = 5;
  EXPECT_EQ(writer.write(params).error().reason, SinkReason::other_camera);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(read_take(path).params.size(), 1u);
}

TEST_F(WriteTake, ConstantsWithoutIdAreValidForOneCameraWithAnyId) {
  TakeWriter writer(path, code, false);
  auto constants = some_constants();
  constants.id = 0;
  ASSERT_TRUE(writer.write(constants));
  auto params = some_params(1);
  params.id = 7;
  ASSERT_TRUE(writer.write(params));
  params.id = 8;
  EXPECT_EQ(writer.write(params).error().reason, SinkReason::other_camera);
  params.id = 0;
  EXPECT_EQ(writer.write(params).error().reason, SinkReason::other_camera);
  ASSERT_TRUE(writer.close());
  const Take take = read_take(path);
  EXPECT_EQ(take.constants.id, 0u);
  ASSERT_EQ(take.params.size(), 1u);
  EXPECT_EQ(take.params[0].id, 7u);
}

TEST_F(WriteTake, WithoutConstantsThereIsNoTake) {
  TakeWriter writer(path, code, false);
  const auto closed = writer.close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().reason, SinkReason::no_constants);
  EXPECT_FALSE(exists(path));
  EXPECT_FALSE(exists(part));
}

TEST_F(WriteTake, ValuesThatAreNotFiniteAreNeverWritten) {
  TakeWriter writer(path, code, false);
  ASSERT_TRUE(writer.write(some_constants()));
  auto params = some_params(1);
  params.k1 = std::numeric_limits<double>::quiet_NaN();
  const auto result = writer.write(params);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, SinkReason::not_encodable);
  EXPECT_STREQ(result.error().fault.name(), wire::name(wire::Reason::not_finite));
  EXPECT_TRUE(writer.write(some_params(2)));
}

TEST_F(WriteTake, OnAFullDiskOnlyTheLineThatDidNotFitIsLost) {
  struct Limit {
    Limit() {
      ::getrlimit(RLIMIT_FSIZE, &before);
      ignored = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~Limit() {
      ::setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, ignored);
    }
    void set(rlim_t bytes) const {
      const rlimit limit{bytes, before.rlim_max};
      ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    }
    rlimit before{};
    void (*ignored)(int) = SIG_DFL;
  } limit;

  TakeWriter writer(path, code, false);
  ASSERT_TRUE(writer.write(some_constants()));
  ASSERT_TRUE(writer.write(some_params(1)));
  limit.set(std::filesystem::file_size(part) + 10);
  const auto full = writer.write(some_params(2));
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().reason, SinkReason::system);
  EXPECT_EQ(full.error().error_number, EFBIG);
  ::setrlimit(RLIMIT_FSIZE, &limit.before);
  EXPECT_TRUE(writer.write(some_params(3)));
  ASSERT_TRUE(writer.close());
  const Take take = read_take(path);
  ASSERT_EQ(take.params.size(), 2u);
  EXPECT_EQ(take.params[0].counter, 1u);
  EXPECT_EQ(take.params[1].counter, 3u);
}

TEST_F(WriteTake, AnUnwritablePathIsNamed) {
  const std::string nowhere = directory / "absent/take.trk";
  const std::string error = test::error_of<TransportError>([&] { const TakeWriter writer(nowhere, code, false); });
  EXPECT_THAT(error, HasSubstr(nowhere));
  EXPECT_THAT(error, HasSubstr("No such file or directory"));
  EXPECT_THROW(TakeWriter(directory.path(), code, /*overwrite=*/true), TransportError);
  EXPECT_THROW(TakeWriter("", code, true), TransportError);
}

}  // namespace trk_bridge::file::take_writer_test
