// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "monitor/view.h"

#include <algorithm>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/wire/format.h"
#include "udp.h"

namespace trk_bridge::monitor::view_test {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

CameraState camera(std::uint32_t id) {
  CameraState state;
  state.key.id = id;
  state.key.sender = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 50123};
  camera::Lens lens;
  lens.image_distance = 12.5;
  auto params = test::params(1234567, id);
  state.latest = ParamsState{params, "ASCII", camera::decode_pose(params), lens, 38.79, 0.012, false, {}};
  state.constants = test::constants();
  state.counts.accepted = 1000;
  state.rate = 50;
  state.jitter = Jitter{20'000'000, 21'000, 310'000, 1'002'000};
  state.rest = {Motion::still, {0.00012, 0.0001, 0.0002, 0.003, 0.002, 0.001}};
  return state;
}

State state_with(std::uint32_t cameras) {
  State state;
  state.source_name = "udp port 7000 on every interface";
  state.source.state = transport::SourceState::receiving;
  state.source.records = 12345;
  state.findings = {{bridge::Condition::receiving, bridge::Level::ok, "receiving from 192.0.2.7:50123 at 50.00 Hz"}};
  for (std::uint32_t id = 1; id <= cameras; ++id) state.cameras.push_back(camera(id));
  return state;
}

State troubled_state(std::uint32_t cameras) {
  State state = state_with(cameras);
  state.source.malformed = 3;
  state.source.refused = 1;
  state.source.kernel_drops = 2;
  MalformedState malformed;
  malformed.fault = wire::Fault{wire::Reason::not_a_number, 9, true};
  malformed.sender = state.cameras.front().key.sender;
  malformed.age = 3.2;
  state.malformed = malformed;
  state.cameras.front().constants.reset();
  state.cameras.front().latest->lens = tl::unexpected(camera::CameraReason::constants_needed);
  state.cameras.front().latest->horizontal_angle = tl::unexpected(camera::CameraReason::constants_needed);
  state.findings = {{bridge::Condition::no_constants, bridge::Level::warn, "id 1: no constants received"}};
  return state;
}

/// With plots.
State state_with_history(std::uint32_t cameras) {
  State state = state_with(cameras);
  for (auto& camera : state.cameras) {
    auto history = std::make_shared<History>();
    for (int n = 0; n < 500; ++n) {
      Values values{};
      values[static_cast<std::size_t>(Value::pan)] = 30 + 0.01 * n;
      history->add(1'000'000'000 + n * 20'000'000LL, values);
    }
    camera.history = history;
    camera.intervals.assign(499, 20'000'000);  // ns
  }
  return state;
}

std::vector<std::string> plain(const std::vector<Line>& lines) {
  std::vector<std::string> texts;
  for (const auto& line : lines) {
    std::string text;
    for (const auto& span : line) text += span.text;
    texts.push_back(text.substr(0, text.find_last_not_of(' ') + 1));
  }
  return texts;
}

std::vector<std::string> text_of(const State& state, Size size, const Choice& choice = {}) {
  return plain(screen_of(state, choice, size));
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

TEST(View, NothingOverflowsAtAnySize) {
  State strange = troubled_state(40);
  strange.source_name = "file " + std::string(300, 'x') + "\xC3\xA4\x1B[31m";
  strange.source.state = transport::SourceState::failed;
  strange.source.error = "take.trk:57: field 9 is not a number";
  strange.cameras[1].latest->pose = tl::unexpected(camera::CameraReason::not_a_rotation);
  strange.cameras[2].latest->params.focdist = 1e300;
  strange.cameras[3].latest->is_silent = true;
  strange.cameras[4].latest.reset();
  strange.findings = {{bridge::Condition::failed, bridge::Level::error, std::string(200, 'y') + "\x1B"}};
  const auto few = state_with_history(2), none = state_with(0);
  Choice guided;
  guided.guide.assign(7, "AXIS CHECK " + std::string(100, 'z'));
  guided.notice = "recording \xC3\xA4";
  for (const Size size : {Size{80, 24},
                          {40, 10},
                          {132, 43},
                          {200, 60},
                          {1, 1},
                          {2, 50},
                          {7, 3},
                          {80, 1},
                          {80, 2},
                          {300, 300},
                          {19, 6},
                          {72, 30}}) {
    for (const State& state : {strange, few, none}) {
      for (const Choice& choice : {Choice{}, guided}) {
        const auto lines = screen_of(state, choice, size);
        EXPECT_LE(lines.size(), size.height) << size.width << "x" << size.height;
        for (const auto& line : lines) {
          std::string text;
          for (const auto& span : line) text += span.text;
          EXPECT_LE(text.size(), size.width) << size.width << "x" << size.height << ": " << text;
          for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
        }
      }
    }
    const auto help = help_screen(size);
    EXPECT_LE(help.size(), size.height);
    for (const auto& line : plain(help)) EXPECT_LE(line.size(), size.width);
  }
  EXPECT_THAT(screen_of(strange, {}, {0, 24}), IsEmpty());
  EXPECT_THAT(screen_of(strange, {}, {80, 0}), IsEmpty());
}

TEST(View, LabelsValuesAndUnitsAreInColumns) {
  const auto lines = text_of(state_with(1), {80, 24});
  EXPECT_THAT(std::vector<std::string>(lines.begin(), lines.begin() + 13),
              ElementsAre("trk monitor  receiving  records 12345  malformed 0", "  udp port 7000 on every interface",
                          "- receiving from 192.0.2.7:50123 at 50.00 Hz",
                          "id 1  50.00 Hz  192.0.2.7:50123  counter 1234567  age 0.01 s",
                          "  x       1.5000 m   y      -2.0000 m   z       1.7500 m",
                          "  pan     30.000 deg tilt    -5.000 deg roll     0.250 deg",
                          "  lens    12.500 mm  fov h   38.790 deg focus    4.500 m   aperture  0.00",
                          "  lost         0     out of order 0",
                          "  interval 20.000 ms jitter   0.021 ms  p99      0.310 ms  worst    1.002 ms",
                          "  noise x   0.12 mm  noise y   0.10 mm  noise z   0.20 mm  n. pan  0.0030 deg",
                          "  n. tilt 0.0020 deg n. roll 0.0010 deg",
                          "  ASCII: euler studio_z_up image_distance consider_blank shift_on_chip",
                          "  image 720 x 576 px chip 8.800 x 6.600 mm"));
  EXPECT_THAT(lines.back(), StartsWith("?: help  q: quit  p: pause  r: reset"));
}

TEST(View, AWideTerminalHasMoreInALine) {
  const std::string text = joined(text_of(state_with(1), {132, 43}));
  EXPECT_THAT(text, HasSubstr("  x       1.5000 m   y      -2.0000 m   z       1.7500 m   pan     30.000 deg tilt    "
                              "-5.000 deg roll     0.250 deg\n"));
}

TEST(View, ASmallTerminalShowsTheImportantAndNamesWhatIsHidden) {
  auto state = troubled_state(2);
  const auto lines = text_of(state, {40, 10});
  ASSERT_THAT(lines, SizeIs(10));
  const std::string text = joined(lines);
  EXPECT_THAT(text, AllOf(HasSubstr("! id 1: no constants received"), HasSubstr("> id 1  50.00 Hz"),
                          HasSubstr("  x       1.5000 m   y      -2.0000 m\n")));
  EXPECT_THAT(text, Not(HasSubstr("ASCII")));
  EXPECT_THAT(lines[8], StartsWith("hidden: findings, "));
  EXPECT_THAT(lines[8], testing::ContainsRegex(", \\+[0-9]$"));
  EXPECT_EQ(lines[9], "?: help  q: quit  p: pause  r: reset");
}

TEST(View, WhatIsHiddenIsNamed) {
  const auto lines = text_of(state_with_history(1), {80, 12});
  EXPECT_EQ(lines[10], "hidden: noise, format, constants, plots");
  EXPECT_THAT(joined(text_of(state_with_history(1), {80, 24})), Not(HasSubstr("hidden")));
  EXPECT_THAT(joined(text_of(state_with_history(1), {60, 40})), HasSubstr("hidden: histogram"));
}

TEST(View, PlotsAndAHistogramUseTheRemainingSpace) {
  const auto lines = text_of(state_with_history(1), {132, 43});
  const std::string text = joined(lines);
  EXPECT_THAT(text, AllOf(HasSubstr("pan (deg), last 10 s"), HasSubstr("tilt (deg), last 10 s"),
                          HasSubstr("intervals, last 10 s"), HasSubstr("20.00 ms   499 ####")));
  // It rises from left to right over the full width.
  const auto title =
      std::find_if(lines.begin(), lines.end(), [](const std::string& line) { return line.rfind("pan (deg)", 0) == 0; });
  ASSERT_NE(title, lines.end());
  EXPECT_THAT(*(title + 1), StartsWith("    34.990 "));
  EXPECT_THAT((title + 1)->substr(94, 4), HasSubstr("'"));

  Choice choice;
  choice.plotted = Value::interval;
  choice.seconds = 60;
  EXPECT_THAT(joined(text_of(state_with_history(1), {80, 24}, choice)), HasSubstr("interval (ms), last 60 s"));
}

TEST(View, OtherCamerasHaveOneLineEachAndTheRestIsCounted) {
  auto lines = text_of(state_with(30), {200, 24});
  ASSERT_THAT(lines, SizeIs(24));
  EXPECT_THAT(joined(lines), AllOf(HasSubstr("> id 1  50.00 Hz"), HasSubstr("\n  id 2 "), HasSubstr("more cameras")));
  Choice choice;
  choice.camera = state_with(30).cameras[4].key;
  lines = text_of(state_with(30), {200, 50}, choice);
  EXPECT_THAT(joined(lines), AllOf(HasSubstr("> id 5  50.00 Hz"), HasSubstr("\n  id 1 "), HasSubstr("\n  id 30 "),
                                   Not(HasSubstr("\n  id 5 ")), Not(HasSubstr("more camera"))));
}

TEST(View, ShowsWhetherItIsPausedAndGuides) {
  Choice choice;
  choice.is_paused = true;
  choice.notice = "recording take.trk";
  choice.guide = {"AXIS CHECK 1/6: pan left now"};
  const auto lines = text_of(state_with(1), {80, 24}, choice);
  EXPECT_THAT(lines[0], StartsWith("trk monitor  PAUSED  receiving"));
  EXPECT_THAT(joined(lines), AllOf(HasSubstr("\nrecording take.trk\n"), HasSubstr("\nAXIS CHECK 1/6: pan left now\n"),
                                   HasSubstr("\nspace: next step  a: end")));
}

TEST(View, TheHelpOfEveryKeyFitsInASmallTerminal) {
  const auto small = plain(help_screen({40, 10}));
  EXPECT_THAT(joined(small), AllOf(HasSubstr("?  help"), HasSubstr("q  quit"), HasSubstr("a  axis check")));
  EXPECT_THAT(small, testing::Contains("Any key goes back."));
  EXPECT_EQ(small.back(), "hidden: more help");
  EXPECT_THAT(joined(plain(help_screen({80, 24}))), AllOf(HasSubstr("noise: "), Not(HasSubstr("hidden"))));
}

TEST(View, HasTheTimeCode) {
  State state = state_with(1);
  state.cameras.front().latest->time_code = base::TimeCodeWithRate{{10, 20, 30, 12, 1, true}, 59.94};
  EXPECT_THAT(plain_lines_of(state, 1).front(), HasSubstr("counter 1234567  10:20:30;12:1  age"));
}

TEST(View, EncoderCountsWithoutALens) {
  State state = state_with(1);
  state.source.doubtful = 2;
  auto& camera = state.cameras.front();
  camera.counts.state = base::CounterState::ignored;
  camera.constants.reset();
  camera.latest->lens = tl::unexpected(camera::CameraReason::no_lens);
  camera.latest->horizontal_angle = tl::unexpected(camera::CameraReason::no_lens);
  camera.latest->encoders = {74565, -9, {}};
  camera.latest->doubt = "wrong checksum";
  const std::string text = joined(text_of(state, {200, 60}));
  EXPECT_THAT(text, HasSubstr("  no lens            zoom encoder 74565 focus encoder -9   wrong checksum"));
  EXPECT_THAT(text, HasSubstr("accepted despite a fault 2"));
  EXPECT_THAT(text, Not(HasSubstr("counter"))) << "there is none";
  EXPECT_THAT(text, Not(HasSubstr("CONSTANTS"))) << "they would be useless";
}

TEST(View, ShowsFaults) {
  auto state = troubled_state(2);
  state.cameras[0].counts.lost = 4;
  state.cameras[0].counts.duplicates = 2;
  state.cameras[0].counts.restarts = 1;
  state.cameras[0].rest.motion = Motion::moving;
  state.cameras[1].latest->is_silent = true;
  state.cameras[1].latest->age = 12.3;
  std::string text = joined(text_of(state, {200, 60}));
  EXPECT_THAT(text, HasSubstr("malformed 3  refused 1  kernel drops 2  udp port 7000 on every interface\n"
                              "! id 1: no constants received\n"
                              "last malformed 3.20 s ago  from 192.0.2.7:50123: field 9 is not a number\n"));
  EXPECT_THAT(text, HasSubstr("no lens: "));
  EXPECT_THAT(text, HasSubstr("lost         4     out of order 0     duplicate    2     restarts     1"));
  EXPECT_THAT(text, HasSubstr("moving"));
  EXPECT_THAT(text, HasSubstr("  id 2               SILENT for  12 s   192.0.2.7:50123"));

  Choice choice;
  choice.camera = state.cameras[1].key;
  state.cameras[1].latest->params.format |= 0x4000;
  state.cameras[1].latest->origin = "binary identified_lp64";
  text = joined(text_of(state, {200, 60}, choice));
  EXPECT_THAT(text, HasSubstr("> id 2  SILENT for 12 s  192.0.2.7:50123  counter 1234567\n"));
  EXPECT_THAT(text, HasSubstr("\n  noise -\n"));
  EXPECT_THAT(text, HasSubstr("binary identified_lp64: euler studio_z_up"));
  EXPECT_THAT(text, HasSubstr("shift_on_chip and unknown bits"));
}

TEST(View, ShowsWhyValuesAreMissing) {
  using camera::CameraReason;
  auto state = state_with(1);
  auto& latest = *state.cameras[0].latest;
  latest.pose = tl::unexpected(CameraReason::not_a_rotation);
  latest.horizontal_angle = tl::unexpected(CameraReason::bad_field_of_view);
  state.cameras[0].constants->chip_width = 0;
  const std::string text = joined(text_of(state, {200, 60}));
  EXPECT_THAT(text, HasSubstr("no pose: " + camera::describe(CameraReason::not_a_rotation)));
  EXPECT_THAT(text, HasSubstr("no angle: " + camera::describe(CameraReason::bad_field_of_view)));
  EXPECT_THAT(text, HasSubstr(camera::describe(CameraReason::bad_constants)));
}

TEST(View, HasTheStateOfTheSource) {
  using transport::SourceState;
  auto state = state_with(1);
  const auto shown = [&](SourceState source) {
    state.source.state = source;
    return text_of(state, {80, 24})[0];
  };
  EXPECT_THAT(shown(SourceState::waiting), StartsWith("trk monitor  waiting  "));
  EXPECT_THAT(shown(SourceState::nothing_valid), StartsWith("trk monitor  nothing valid  "));
  EXPECT_THAT(shown(SourceState::only_refused), StartsWith("trk monitor  nothing valid  "));
  EXPECT_THAT(shown(SourceState::receiving), StartsWith("trk monitor  receiving  "));
  EXPECT_THAT(shown(SourceState::ended), StartsWith("trk monitor  ended  "));
  EXPECT_THAT(shown(SourceState::failed), StartsWith("trk monitor  failed  "));
}

TEST(View, FaultsAreHighlighted) {
  auto state = troubled_state(1);
  state.cameras[0].counts.lost = 4;
  state.findings.insert(state.findings.begin(), {bridge::Condition::alarm, bridge::Level::error, "ALARM"});
  std::vector<std::string> warnings, errors;
  for (const auto& line : screen_of(state, {}, {200, 60})) {
    for (const auto& span : line) {
      if (span.style == Style::warning) warnings.push_back(span.text);
      if (span.style == Style::error) errors.push_back(span.text);
    }
  }
  EXPECT_THAT(warnings, ElementsAre("malformed 3", "refused 1", "kernel drops 2", "! id 1: no constants received",
                                    "last malformed 3.20 s ago", "from 192.0.2.7:50123: field 9 is not a number",
                                    HasSubstr("lost         4")));
  EXPECT_THAT(errors, ElementsAre("! ALARM", HasSubstr("no lens: ")));
}

TEST(View, BeforeTheFirstRecordItShowsWhatItWaitsFor) {
  State state;
  state.source_name = "shm slot 7";
  state.findings = {{bridge::Condition::waiting, bridge::Level::stale, "waiting for slot 7: no segment"}};
  const auto lines = text_of(state, {80, 24});
  EXPECT_EQ(lines[0], "trk monitor  waiting  records 0  malformed 0  shm slot 7");
  EXPECT_EQ(lines[1], "! waiting for slot 7: no segment");
  EXPECT_THAT(plain_lines_of(state, 1), ElementsAre("! waiting for slot 7: no segment",
                                                    "trk monitor  waiting  records 0  malformed 0  shm slot 7"));
}

TEST(View, ThereIsOnePlainLinePerCamera) {
  const auto lines = plain_lines_of(state_with(2), 1);
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_THAT(lines[1], AllOf(StartsWith("id 2  50.00 Hz  192.0.2.7:50123  counter 1234567"),
                              HasSubstr("  x 1.5000 m  y -2.0000 m"), HasSubstr("chip 8.800 x 6.600 mm")));
}

TEST(View, PlainLinesShowEachNewMalformedRecordOnce) {
  auto state = troubled_state(1);
  EXPECT_THAT(plain_lines_of(state, 1), ElementsAre("! id 1: no constants received", StartsWith("id 1  ")));
  state.malformed->age = 0.9;
  EXPECT_THAT(plain_lines_of(state, 1),
              ElementsAre("! id 1: no constants received", HasSubstr("field 9 is not a number"), StartsWith("id 1  ")));
}

}  // namespace trk_bridge::monitor::view_test
