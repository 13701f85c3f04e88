// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The version, help, manual page, completions and command line errors of trk.
#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "program.h"
#include "temporary_directory.h"
#include "vectors.h"

namespace trk_bridge::tools::help_program_test {

using test::Program;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

struct Result {
  int code;
  std::string out, err;
};

Result result_of(std::vector<std::string> words) {
  Program program(std::move(words));
  Result result{0, program.rest_of_out(), program.rest_of_err()};
  result.code = program.wait();
  return result;
}

Result trk(std::vector<std::string> words) {
  words.insert(words.begin(), TRK_TOOL);
  return result_of(std::move(words));
}

std::string output_of(const std::vector<std::string>& words) {
  const auto result = trk(words);
  EXPECT_EQ(result.code, 0) << result.err;
  return result.out;
}

/// A script in a file, which is removed with it.
class Script {
 public:
  explicit Script(const std::string& text) { std::ofstream(path) << text; }

  const test::TemporaryDirectory directory;
  const std::string path = directory / "script";
};

TEST(TrkHelp, VersionIsThatOfThePackage) { EXPECT_EQ(output_of({"--version"}), "trk " TRK_BRIDGE_VERSION "\n"); }

TEST(TrkHelp, EndpointsAndTheirOptionsAreExplained) {
  EXPECT_THAT(output_of({"help", "endpoints"}),
              AllOf(HasSubstr("opentrackio://HOST:PORT"), HasSubstr("Options of udp, reading:\n  allow="),
                    HasSubstr("Options of file, writing:\n  timecode="), HasSubstr("\n  lead=")));
}

TEST(TrkHelp, ACommandIsExplained) { EXPECT_EQ(output_of({"help", "relay"}), output_of({"relay", "--help"})); }

TEST(TrkErrors, AreOneLineWithASuggestion) {
  const std::string take = "file:" + test::data_path("field/takes/euler.trk");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"dmp", take}, "unknown command \"dmp\", did you mean dump? (see trk --help)"},
      {{"frobnicate"}, "unknown command \"frobnicate\"; commands are dump, relay, "},
      {{}, "no command is given; commands are dump, relay, "},
      {{"help", "endpoint"}, "no help on \"endpoint\", did you mean endpoints?"},
      {{"dump", take, "--jsn"}, "unknown option --jsn, did you mean --json? (see trk dump --help)"},
      {{"dump", take, "--frobnicate=1"}, "unknown option --frobnicate=1 (see trk dump --help)"},
      {{"dump", take, "more"}, "unexpected argument \"more\""},
      {{"dump", take, "--count", "-1"}, "--count: \"-1\": must be a whole number of at least 1"},
      {{"dump", take, "--count", "1.5"}, "--count: \"1.5\": must be a whole number of at least 1"},
      {{"dump", take, "--seconds", "0"}, "--seconds: \"0\": must be a number above 0"},
      {{"relay", take, take, "--id", "4294967296"},
       "--id: \"4294967296\": must be a whole number from 0 to 4294967295"},
      {{"dump", "/tmp/take.trk"}, "did you mean file:/tmp/take.trk? Allowed are "},
  };
  for (const auto& [words, error] : cases) {
    const auto result = trk(words);
    EXPECT_EQ(result.code, 2) << error;
    EXPECT_THAT(result.err, AllOf(HasSubstr("trk: error: "), HasSubstr(error), EndsWith(")\n")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(TrkRelay, EndsAfterSeconds) {
  const test::TemporaryDirectory directory;
  const auto result = trk({"relay", "file:" + test::data_path("field/takes/euler.trk") + "?loop=1&rate=1000",
                           "file:" + (directory / "copy.trk"), "--seconds", "0.3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("sent to file "));
}

TEST(TrkManual, IsAPageWithoutWarnings) {
  const Script page(output_of({"manual"}));
  EXPECT_THAT(output_of({"manual"}), AllOf(HasSubstr(".TH TRK 1"), HasSubstr("trk_bridge " TRK_BRIDGE_VERSION)));
  if (::access("/usr/bin/man", X_OK) != 0) GTEST_SKIP() << "man is not installed";
  const auto shown = result_of({"/usr/bin/env", "LC_ALL=C.UTF-8", "MANWIDTH=100", "/usr/bin/man", "--warnings", "-E",
                                "UTF-8", "-P", "cat", "-l", page.path});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.err, "");
  EXPECT_THAT(shown.out, AllOf(HasSubstr("trk relay [OPTION]... SOURCE SINK..."), HasSubstr("--seconds S"),
                               HasSubstr("OPTIONS OF FREED, READING"), HasSubstr("checksum="), Not(HasSubstr("\\f"))));
}

/// The completions of bash for the last word.
std::string offered(const std::string& words) {
  static const Script script(output_of({"completion", "bash"}));
  const auto result =
      result_of({"/bin/bash", "--norc", "-c",
                 "cd '" + test::data_path("field/takes") + "' && . '" + script.path + "' && COMP_WORDS=(" + words +
                     ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _trk && "
                     "[[ $(complete -p trk) == 'complete -F _trk trk' ]] && echo \"${COMPREPLY[*]}\""});
  EXPECT_EQ(result.code, 0) << words;
  EXPECT_EQ(result.err, "") << words;
  return result.out.substr(0, result.out.find('\n'));
}

TEST(TrkCompletion, OfBashOffersCommandsOptionsAndValues) {
  EXPECT_EQ(offered("trk du"), "dump");
  EXPECT_THAT(offered("trk ''"), AllOf(HasSubstr("relay"), HasSubstr("--version"), Not(HasSubstr("manual"))));
  EXPECT_EQ(offered("trk dump --"), "--help --json --count --seconds");
  EXPECT_EQ(offered("trk dump -h --c"), "--count");
  EXPECT_EQ(offered("trk relay --preset pix"), "pixotope");
  EXPECT_EQ(offered("trk dump --count ''"), "");
  EXPECT_EQ(offered("trk completion ''"), "bash zsh");
  EXPECT_EQ(offered("trk relay shm:7 op"), "opentrackio://");
  EXPECT_EQ(offered("trk dump file : euler.t"), "euler.trk");
  EXPECT_EQ(offered("trk dump udp : euler.t"), "");
  EXPECT_EQ(offered("trk lens euler.t"), "euler.trk");
}

TEST(TrkCompletion, OfZshCompletesWhatIsTyped) {
  if (::access("/usr/bin/zsh", X_OK) != 0) GTEST_SKIP() << "zsh is not installed";
  const Script script(output_of({"completion", "zsh"}));
  const auto result = result_of({"/usr/bin/zsh", "-f", ZSH_SCRIPT, script.path});
  EXPECT_EQ(result.out, "dump\ndump --json\nrelay --preset\nrelay --preset pixotope\ndump opentrackio://\n")
      << result.err;
}

}  // namespace trk_bridge::tools::help_program_test
