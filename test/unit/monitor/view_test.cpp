#include "monitor/view.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/wire/format.h"
#include "udp.h"

namespace trk_bridge::monitor {
namespace {

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
  return state;
}

std::vector<std::string> text_of(const State& state, Size size) {
  std::vector<std::string> lines;
  for (const auto& line : screen_of(state, size)) {
    std::string text;
    for (const auto& span : line) text += span.text;
    lines.push_back(text);
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

TEST(View, NothingOverflowsWhateverTheSize) {
  State strange = troubled_state(40);
  strange.source_name = "file " + std::string(300, 'x') + "\xC3\xA4\x1B[31m";
  strange.source.state = transport::SourceState::failed;
  strange.source.error = "take.trk:57: field 9 is not a number";
  strange.cameras[1].latest->pose = tl::unexpected(camera::CameraReason::not_a_rotation);
  strange.cameras[2].latest->params.focdist = 1e300;
  strange.cameras[3].latest->is_silent = true;
  strange.cameras[4].latest.reset();
  const auto few = state_with(2), none = state_with(0);
  for (const Size size : {Size{80, 24}, {40, 10}, {200, 60}, {1, 1}, {2, 50}, {7, 3}, {80, 1}, {80, 2}, {300, 300}}) {
    for (const State& state : {strange, few, none}) {
      const auto lines = text_of(state, size);
      EXPECT_LE(lines.size(), size.height) << size.width << "x" << size.height;
      for (const auto& line : lines) {
        EXPECT_LE(line.size(), size.width) << size.width << "x" << size.height << ": " << line;
        for (const char c : line) EXPECT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
      }
    }
  }
  EXPECT_THAT(screen_of(strange, {0, 24}), IsEmpty());
  EXPECT_THAT(screen_of(strange, {80, 0}), IsEmpty());
}

TEST(View, TwoCamerasInEightyByTwentyFour) {
  const auto lines = text_of(state_with(2), {80, 24});
  const auto first = std::vector<std::string>(lines.begin(), lines.begin() + 11);
  EXPECT_THAT(
      first,
      ElementsAre("trk monitor  receiving  q: quit", "records 12345  malformed 0  udp port 7000 on every interface", "",
                  "id 1  50.00 Hz  192.0.2.7:50123  counter 1234567  age 0.01 s",
                  "  x   1.5000 y  -2.0000 z   1.7500 m pan   30.000 tilt  -5.000 roll    0.250 deg",
                  "  lens 12.500 mm  horizontal 38.790 deg  focus 4.500 m  aperture 0.00", "  lost 0  out of order 0",
                  "  jitter p50 0.021  p99 0.310  worst 1.002 ms  interval 20.000 ms",
                  "  noise at rest x 0.12 y 0.10 z 0.20 mm pan 0.0030 tilt 0.0020 roll 0.0010 deg",
                  "  ASCII: euler studio_z_up image_distance consider_blank shift_on_chip",
                  "  image 720 x 576 px  chip 8.800 x 6.600 mm"));
  EXPECT_THAT(joined(lines), HasSubstr("\n\nid 2  50.00 Hz"));
}

TEST(View, InFortyByTenTheImportantIsThere) {
  const auto lines = text_of(troubled_state(2), {40, 10});
  const std::string text = joined(lines);
  EXPECT_THAT(text, AllOf(HasSubstr("malformed 3"), HasSubstr("id 1  50.00 Hz"), HasSubstr("id 2  50.00 Hz"),
                          HasSubstr("x   1.5000 y  -2.0000 z   1.7500 m")));
  EXPECT_THAT(text, Not(HasSubstr("ASCII")));
}

TEST(View, ManyCamerasAreALineEachAndTheRestCounted) {
  auto lines = text_of(state_with(30), {200, 24});
  ASSERT_THAT(lines, SizeIs(24));
  EXPECT_THAT(lines[2], StartsWith("id 1 "));
  EXPECT_THAT(lines[22], StartsWith("id 21 "));
  EXPECT_EQ(lines[23], "9 more");
  lines = text_of(state_with(22), {200, 24});
  EXPECT_THAT(lines[23], StartsWith("id 22 "));
  lines = text_of(state_with(20), {200, 60});
  ASSERT_THAT(lines, SizeIs(60));
  EXPECT_THAT(lines[59], Not(IsEmpty()));
}

TEST(View, HasTheTimeCode) {
  State state = state_with(1);
  state.cameras.front().latest->time_code = base::CountedTimeCode{{10, 20, 30, 12, 1, true}, 59.94};
  EXPECT_THAT(plain_lines_of(state, 1).front(), HasSubstr("counter 1234567  10:20:30;12:1  age"));
}

TEST(View, CountsOfALensWithoutALens) {
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
  EXPECT_THAT(text, HasSubstr("no lens  zoom encoder 74565  focus encoder -9  wrong checksum\n"));
  EXPECT_THAT(text, HasSubstr("taken in spite of a fault 2"));
  EXPECT_THAT(text, Not(HasSubstr("counter"))) << "there is none";
  EXPECT_THAT(text, Not(HasSubstr("CONSTANTS"))) << "they would be of no use";
}

TEST(View, TellsTrouble) {
  auto state = troubled_state(2);
  state.cameras[0].counts.lost = 4;
  state.cameras[0].counts.duplicates = 2;
  state.cameras[0].counts.restarts = 1;
  state.cameras[0].rest.motion = Motion::moving;
  state.cameras[1].latest->is_silent = true;
  state.cameras[1].latest->age = 12.3;
  state.cameras[1].latest->params.format |= 0x4000;
  state.cameras[1].latest->origin = "binary identified_lp64";
  const std::string text = joined(text_of(state, {200, 60}));
  EXPECT_THAT(text, HasSubstr("malformed 3  refused 1  kernel drops 2  udp port 7000 on every interface\n"
                              "last malformed 3.20 s ago  from 192.0.2.7:50123:  field 9 is not a number\n"));
  EXPECT_THAT(text, HasSubstr("NO CONSTANTS have come"));
  EXPECT_THAT(text, HasSubstr("no lens: "));
  EXPECT_THAT(text, HasSubstr("lost 4  out of order 0  duplicate 2  restarts 1"));
  EXPECT_THAT(text, HasSubstr("\n  moving\n"));
  EXPECT_THAT(text, HasSubstr("id 2  SILENT for 12 s  192.0.2.7:50123  counter 1234567\n"));
  EXPECT_THAT(text, HasSubstr("noise at rest -\n  binary identified_lp64: euler studio_z_up"));
  EXPECT_THAT(text, HasSubstr("shift_on_chip and unknown bits"));
}

TEST(View, TroubleStandsOut) {
  auto state = troubled_state(1);
  state.cameras[0].counts.lost = 4;
  std::vector<std::string> warnings;
  for (const auto& line : screen_of(state, {200, 60})) {
    for (const auto& span : line) {
      if (span.style == Style::warning) warnings.push_back(span.text);
    }
  }
  EXPECT_THAT(warnings,
              ElementsAre("malformed 3", "refused 1", "kernel drops 2", "last malformed 3.20 s ago",
                          "from 192.0.2.7:50123:", "field 9 is not a number", "NO CONSTANTS have come", "lost 4"));
}

TEST(View, BeforeTheFirstRecordItSaysWhatItWaitsFor) {
  State state;
  state.source_name = "shm slot 7";
  state.source.waiting_for = "slot 7: no segment";
  EXPECT_EQ(text_of(state, {80, 24}).front(), "trk monitor  waiting for slot 7: no segment  q: quit");
  EXPECT_THAT(plain_lines_of(state, 1),
              ElementsAre("trk monitor  waiting for slot 7: no segment  records 0  malformed 0  shm slot 7"));
}

TEST(View, PlainLinesAreOneACamera) {
  const auto lines = plain_lines_of(state_with(2), 1);
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_THAT(lines[1], AllOf(StartsWith("id 2  50.00 Hz  192.0.2.7:50123  counter 1234567"),
                              HasSubstr("  x   1.5000  y  -2.0000"), HasSubstr("chip 8.800 x 6.600 mm")));
}

TEST(View, PlainLinesShowEachNewMalformedRecordOnce) {
  auto state = troubled_state(1);
  EXPECT_THAT(plain_lines_of(state, 1), SizeIs(1));
  state.malformed->age = 0.9;
  const auto lines = plain_lines_of(state, 1);
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_THAT(lines[0], HasSubstr("field 9 is not a number"));
}

}  // namespace
}  // namespace trk_bridge::monitor
