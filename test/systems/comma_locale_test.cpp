// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// In a locale with decimal commas, all numbers are still written and read with points: by the libraries after
// setlocale() and std::locale::global(), and by programs that are started in the locale.
#include "comma_locale.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "bridge/diagnostic_text.h"
#include "camera_records.h"
#include "delay/report.h"
#include "lens/table.h"
#include "plot/plot.h"
#include "program.h"
#include "temporary_directory.h"
#include "trk_bridge/base/sequence.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_file.h"
#include "udp.h"

namespace trk_bridge {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class InALocaleWithCommas : public testing::Test {
 protected:
  static void TearDownTestSuite() { locale_.reset(); }
  void SetUp() override {
    try {
      if (!locale_) locale_.emplace();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  /// The result of `action` in the locale. Expects the same result in the C locale.
  template <typename Action>
  auto same(Action action) const {
    const auto before = action();
    const test::CommaLocale::Stay stay(*locale_);
    const auto result = action();
    EXPECT_EQ(result, before);
    return result;
  }

  std::string output_of(const std::vector<std::string>& words, bool in_the_locale) const {
    std::vector<std::string> all = in_the_locale ? locale_->prefix() : std::vector<std::string>{};
    all.insert(all.end(), words.begin(), words.end());
    test::Program program(all);
    std::string output = program.rest_of_out() + program.rest_of_err();
    EXPECT_EQ(program.wait(), 0) << output;
    return output;
  }

  static inline std::optional<test::CommaLocale> locale_;
  test::TemporaryDirectory folder_;
};

/// The angles have decimals that Free-D can send exactly.
wire::CameraParams params() {
  auto p = test::params(1234567, 7);
  p.euler = {1.5, -2.25, 1.75, 30.5, -5.25, 0.25};
  return p;
}

/// The records that a source receives when a sink sends constants and parameters to it.
std::vector<wire::Record> sent(const std::string& scheme, const std::string& source_options,
                               const std::string& sink_options) {
  const auto source = endpoints::open_source(scheme + "://127.0.0.1:0" + source_options);
  const auto sink =
      endpoints::open_sink(scheme + "://127.0.0.1:" + std::to_string(test::port_of(*source)) + sink_options);
  EXPECT_TRUE(sink->write(test::constants(1920, 7)));
  EXPECT_TRUE(sink->write(params(), {1'000'000'000}));
  std::vector<wire::Record> records;
  transport::Reception reception;
  while (records.empty() || !std::holds_alternative<wire::CameraParams>(records.back())) {
    if (test::next(*source, reception) != transport::Event::sample) {
      ADD_FAILURE() << scheme << ": nothing received, or " << describe(reception.fault);
      break;
    }
    records.push_back(reception.sample.record);
  }
  return records;
}

TEST_F(InALocaleWithCommas, StreamsAndPrintfWriteCommas) {
  const test::CommaLocale::Stay stay(*locale_);
  std::ostringstream text;
  text << 1234.5;
  EXPECT_EQ(text.str(), "1.234,5");
  char printed[16];
  std::snprintf(printed, sizeof printed, "%.1f", 0.5);
  EXPECT_STREQ(printed, "0,5");
}

TEST_F(InALocaleWithCommas, EveryProtocolSendsAndReceives) {
  EXPECT_EQ(same([] { return sent("udp", "", ""); }).back(), wire::Record(params()));
  for (const char* const encoding : {"?encoding=json&rate=59.94", "?encoding=cbor"}) {
    EXPECT_EQ(same([&] { return sent("opentrackio", "", encoding); }).back(), wire::Record(params()));
  }
  const std::string lens = std::string("?lens=") + LENS_EXAMPLE;
  const auto with_lens = same([&] { return sent("freed", lens, lens); });
  EXPECT_NEAR(std::get<wire::CameraParams>(with_lens.back()).fov, 42, 0.05);
}

TEST_F(InALocaleWithCommas, TakesAreWrittenAndRead) {
  const auto take = [this] {
    const std::string path = folder_ / "take.trk";
    const auto sink = endpoints::open_sink("file:" + path + "?overwrite=1&rate=59.94");
    EXPECT_TRUE(sink->write(test::constants(1920, 7)));
    EXPECT_TRUE(sink->write(params(), {1'000'000'000}));
    EXPECT_TRUE(sink->close());
    const auto source = endpoints::open_source("file:" + path + "?speed=0&rate=59.94");
    transport::Reception reception;
    while (test::next(*source, reception) == transport::Event::sample) {
      if (std::holds_alternative<wire::CameraParams>(reception.sample.record)) {
        EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), params());
      }
    }
    return test::read_text(path);
  };
  EXPECT_THAT(same(take), HasSubstr("1.5 -2.25 1.75 30.5"));
}

TEST_F(InALocaleWithCommas, LensTablesAreRead) {
  const test::CommaLocale::Stay stay(*locale_);
  const auto table = lens::Table::load(LENS_EXAMPLE);
  ASSERT_TRUE(table) << table.error();
  EXPECT_EQ((*table)->points().constants->chip_width, 9.59);
  const auto refused =
      lens::Table::from_yaml("points:\n- {zoom: 0, focal_length: 8}\n- {zoom: 1.5, focal_length: -0.5}\n", "lens.yaml");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("-0.5"));
}

TEST_F(InALocaleWithCommas, PlotsHavePoints) {
  const std::string svg = same([] {
    return plot::to_svg("title", {{"x", "y", {0, 2500}, {-0.5, 0.5}, {{{{0, 0.25}, {1234.5, -0.25}}, "", "", false}}}});
  });
  EXPECT_THAT(svg, testing::AllOf(HasSubstr(">2000<"), HasSubstr(">-0.5<")));
}

TEST_F(InALocaleWithCommas, MessagesHavePoints) {
  EXPECT_EQ(same([] { return bridge::two_decimals(1234.5); }), "1234.50");
  EXPECT_EQ(same([] { return bridge::duration_text(0.5); }), "0.5 s");
  delay::Measurement measured;
  measured.delay = 0.0432;
  EXPECT_EQ(same([&] { return delay::setting(measured); }), "for ros_to_trk: delay:=0.0432");
  EXPECT_EQ(same([] {
              try {
                (void)base::Sequence(-0.5);
              } catch (const std::invalid_argument& error) {
                return std::string(error.what());
              }
              return std::string();
            }),
            "field_rate = -0.5: allowed is more than 0 Hz and at most 1000000 Hz");
  for (const char* const url : {"udp://:99999", "file:a?speed=1,5", "file:a?rate=-0.5"}) {
    EXPECT_THAT(same([&] { return endpoints::parse_source(url).error(); }), Not(IsEmpty()));
  }
  EXPECT_TRUE(same([] { return endpoints::parse_sink("udp://127.0.0.1:7000?delay=0.04,0.02,0").has_value(); }));
}

TEST_F(InALocaleWithCommas, TheCInterfaceWritesAndReads) {
  const std::string text = same([] {
    trkCameraParams p{};
    p.format = trkEuler;
    p.t.e.x = 1234567.25;
    p.fov = 0.5;
    char buffer[trkStringSize];
    EXPECT_GT(trkParamsToString(&p, buffer), 0);
    trkCameraParams read{};
    EXPECT_EQ(trkStringToParams(buffer, &read), 1);
    EXPECT_EQ(read.t.e.x, 1234567.25);
    EXPECT_EQ(trkStringToParams("1 1,5 0 0 0 0 0 1 0 0 0 0 0 0 1", &read), 0);
    return std::string(buffer);
  });
  EXPECT_THAT(text, HasSubstr("1234567.25"));
}

TEST_F(InALocaleWithCommas, ProgramsPrintTheSame) {
  const std::string take = "file:" + std::string(TRK_BRIDGE_TEST_DATA) + "/field/takes/euler.trk";
  for (const auto& words : std::vector<std::vector<std::string>>{
           {TRK_TOOL, "dump", take + "?speed=0", "--count", "3"},
           {TRK_TOOL, "dump", take + "?speed=0", "--count", "3", "--json"},
           {TRK_TOOL, "monitor", take, "--seconds", "0.5"},
           {TRK_TOOL, "lens", LENS_EXAMPLE},
           {TRK_TOOL, "presets", "--json"},
           {TRK_TOOL, "help", "endpoints"},
       }) {
    if (words[1] == "monitor") {
      // Its lines begin with the time.
      EXPECT_THAT(output_of(words, true), HasSubstr("50.00 Hz"));
    } else {
      EXPECT_EQ(output_of(words, true), output_of(words, false));
    }
  }
  const std::string in_c = folder_ / "c.svg", in_the_locale = folder_ / "comma.svg";
  (void)output_of({TRK_TOOL, "lens", LENS_EXAMPLE, "--plot", in_c}, false);
  (void)output_of({TRK_TOOL, "lens", LENS_EXAMPLE, "--plot", in_the_locale}, true);
  EXPECT_EQ(test::read_text(in_the_locale), test::read_text(in_c));
}

}  // namespace
}  // namespace trk_bridge
