// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bytes_read.h"
#include "error_of.h"
#include "file/scheme.h"
#include "play_file.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"
#include "vectors.h"

namespace trk_bridge::file::file_source_test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;
using transport::SenderKind;
using transport::SinkReason;
using transport::SourceState;
using transport::TransportError;

constexpr std::int64_t field = 20'000'000;  // ns at 50 Hz
constexpr std::int64_t day = 86'400'000'000'000;
// 10:20:30:12:1 at 50 Hz.
constexpr std::int64_t of_day = (10 * 3600 + 20 * 60 + 30) * 1'000'000'000LL + 24 * field;

TEST_F(PlayFile, ConstantsFirstThenEveryFieldThenTheEnd) {
  auto settings = take_of(3);
  settings.speed = 0;
  const auto source = open_source(settings, 50.0);
  EXPECT_EQ(source->statistics().state, SourceState::waiting);
  EXPECT_THAT(source->statistics().waiting_for, HasSubstr(path));
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_TRUE(is_constants(r));
  EXPECT_EQ(r.sample.sender.kind, SenderKind::file);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_EQ(counter(r), i);
  }
  EXPECT_EQ(source->statistics().state, SourceState::receiving);
  EXPECT_EQ(source->receive(r, -1ns), Event::ended);
  EXPECT_EQ(source->receive(r, -1ns), Event::ended);
  EXPECT_EQ(source->statistics().state, SourceState::ended);
  EXPECT_EQ(source->statistics().records, 4u);
}

/// "-" without one.
std::string time_code(const Reception& r) {
  return r.sample.time_code ? base::to_string(r.sample.time_code->code) : "-";
}

TEST_F(PlayFile, EveryFieldHasItsTimeCodeInEveryRound) {
  auto settings = take_of(3);
  settings.speed = 0;
  settings.loop = true;
  const auto source = open_source(settings, 50.0);
  Reception r;
  for (int round = 0; round < 2; ++round) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_EQ(time_code(r), "-") << "constants";
    for (const char* code : {"10:20:30:12:1", "10:20:30:12:2", "10:20:30:13:1"}) {
      ASSERT_EQ(source->receive(r, 0ns), Event::sample);
      EXPECT_EQ(time_code(r), code);
      EXPECT_EQ(r.sample.time_code->rate, 50);
    }
  }
}

TEST_F(PlayFile, DropFrameTimeCodesAreCountedAsSuch) {
  auto settings = take_of(3);
  std::string text = test::read_text(path);
  test::write_text(path, text.replace(text.find("10:20:30:12:1"), 13, "23:58:59;29:1"));
  settings.speed = 0;
  settings.date = 0;
  settings.rate = 59.94;
  const auto source = open_source(settings, 50.0);
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  // 23:59:00;02:1 is the last minute's first field: 17982 frames in ten minutes, 1798 in the last one.
  const std::int64_t last_minute = 2 * (144 * 17'982 - 1'798);
  for (const auto& [code, count] : {std::pair("23:58:59;29:1", last_minute - 2),
                                    {"23:58:59;29:2", last_minute - 1},
                                    {"23:59:00;02:1", last_minute}}) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_EQ(time_code(r), code);
    EXPECT_NEAR(static_cast<double>(r.sample.arrival), static_cast<double>(count) * 1e9 * 1001 / 60000, 1);
  }
  settings.rate = 50;
  EXPECT_THAT(test::error_of<TransportError>([&] { static_cast<void>(open_source(settings, 50.0)); }),
              HasSubstr("29.97, 59.94 and 119.88"));
  settings.time = FileTime::now;
  const auto without = open_source(settings, 50.0);
  ASSERT_EQ(without->receive(r, 0ns), Event::sample);
  ASSERT_EQ(without->receive(r, 0ns), Event::sample);
  EXPECT_EQ(time_code(r), "-") << "none that fits the rate";
}

TEST_F(PlayFile, ArrivalIsTheTimeCodeOnTheDateAndRisesOverLoops) {
  auto settings = take_of(2);
  settings.speed = 0;
  settings.loop = true;
  settings.date = 20'000 * 86'400;  // 2024-10-04
  const auto source = open_source(settings, 50.0);
  Reception r;
  std::int64_t index = 0;
  for (int round = 0; round < 3; ++round) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_TRUE(is_constants(r)) << "round " << round;
    EXPECT_EQ(r.sample.arrival, 20'000 * day + of_day + index * field);
    for (std::uint64_t i = 1; i <= 2; ++i, ++index) {
      ASSERT_EQ(source->receive(r, 0ns), Event::sample);
      EXPECT_EQ(counter(r), i);
      EXPECT_EQ(r.sample.arrival, 20'000 * day + of_day + index * field);
    }
  }
}

TEST_F(PlayFile, WithoutADateItIsToday) {
  auto settings = take_of(1);
  settings.speed = 0;
  const std::int64_t before = std::time(nullptr) / 86'400;
  const auto source = open_source(settings, 50.0);
  const std::int64_t after = std::time(nullptr) / 86'400;
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_THAT(r.sample.arrival, testing::AllOf(testing::Ge(before * day + of_day), testing::Le(after * day + of_day)));
}

TEST_F(PlayFile, TheRateOfTheSettingsOverridesTheCallers) {
  auto settings = take_of(2);
  settings.speed = 0;
  settings.date = 0;
  const auto arrival_of_second = [](const SourceSettings& e, double field_rate) {
    const auto source = open_source(e, field_rate);
    Reception r;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(source->receive(r, 0ns), Event::sample);
    return r.sample.arrival;
  };
  // 30 frames a second: frame 12 is field 24.
  const std::int64_t seconds = 10 * 3600 + 20 * 60 + 30;
  EXPECT_EQ(arrival_of_second(settings, 60.0),
            seconds * 1'000'000'000 + 25 * 1'000'000'000LL / 60 + 1);  // .6 rounds up
  settings.rate = 100.0;
  EXPECT_EQ(arrival_of_second(settings, 60.0), seconds * 1'000'000'000 + 250'000'000LL);
}

TEST_F(PlayFile, ArrivalNowIsTheWallClock) {
  auto settings = take_of(1);
  settings.speed = 0;
  settings.time = FileTime::now;
  const auto source = open_source(settings, 50.0);
  const auto wall = [] {
    return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  };
  Reception r;
  const std::int64_t before = wall();
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_THAT(r.sample.arrival, testing::AllOf(testing::Ge(before), testing::Le(wall())));
}

TEST_F(PlayFile, NoFieldIsEverEarlyAndTheScheduleDoesNotDrift) {
  auto settings = take_of(21);
  settings.speed = 4;  // 5 ms a field
  const auto source = open_source(settings, 50.0);
  Reception r;
  const auto begin = Clock::now();
  ASSERT_EQ(source->receive(r, -1ns), Event::sample);
  const auto begun = Clock::now();
  for (int i = 0; i <= 20; ++i) {
    ASSERT_EQ(source->receive(r, -1ns), Event::sample);
    EXPECT_GE(Clock::now() - begin, i * 5ms);
    // A reader that was late catches up: overdue records are given without waiting.
    if (i == 10) {
      while (Clock::now() - begun < 75ms) std::this_thread::yield();
      for (int late = 11; late <= 15; ++late, ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    }
  }
  EXPECT_EQ(counter(r), 21u);
}

TEST_F(PlayFile, BeforeItsTimeAFieldIsNotReturned) {
  auto settings = take_of(2);
  settings.speed = 0.001;  // 20 s a field
  const auto source = open_source(settings, 50.0);
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(source->receive(r, 0ns), Event::idle);
  const auto begin = Clock::now();
  EXPECT_EQ(source->receive(r, 3ms), Event::idle);
  EXPECT_GE(Clock::now() - begin, 3ms);
}

TEST_F(PlayFile, StopWakesAWaitingReaderForGood) {
  auto settings = take_of(2);
  settings.speed = 1e-6;
  const auto source = open_source(settings, 50.0);
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  std::thread stopper([&source] { source->stop(); });
  EXPECT_EQ(source->receive(r, -1ns), Event::stopped);
  stopper.join();
  EXPECT_EQ(source->receive(r, -1ns), Event::stopped);
}

TEST_F(PlayFile, UnknownFormatBitsAreCounted) {
  auto settings = take_of(0);
  test::write_text(path, test::read_text(path) + "401 1 2 3 4 5 6 50 0 0 0 0 5 8 1\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 2\n");
  settings.speed = 0;
  const auto source = open_source(settings, 50.0);
  Reception r;
  for (int i = 0; i < 3; ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(source->statistics().unknown_format_bits, 1u);
}

TEST_F(PlayFile, ATruncatedLineIsReportedOnceAndTheRestIsPlayed) {
  auto settings = take_of(2);
  test::write_text(path, test::read_text(path) + "1 1 2 3 4");
  settings.speed = 0;
  settings.loop = true;
  const auto source = open_source(settings, 50.0);
  Reception r;
  for (int i = 0; i < 3; ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  ASSERT_EQ(source->receive(r, 0ns), Event::malformed);
  EXPECT_THAT(describe(r.fault), HasSubstr("line 6 is truncated: field 6 is missing"));
  EXPECT_EQ(r.sample.sender.kind, SenderKind::file);
  for (int i = 0; i < 6; ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(source->statistics().malformed, 1u);
  EXPECT_EQ(source->statistics().state, SourceState::receiving);
}

TEST_F(PlayFile, LenientSkipsOneLineAndTheOthersKeepTheirTimes) {
  auto settings = take_of(1);
  test::write_text(path, test::read_text(path) + "oops\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 3\n");
  settings.speed = 0;
  settings.date = 0;
  settings.lenient = true;
  settings.loop = true;
  const auto source = open_source(settings, 50.0);
  Reception r;
  for (int round = 0; round < 2; ++round) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    EXPECT_TRUE(is_constants(r));
    for (const int i : {1, 3}) {
      ASSERT_EQ(source->receive(r, 0ns), Event::sample);
      EXPECT_EQ(counter(r), static_cast<std::uint64_t>(i));
      EXPECT_EQ(r.sample.arrival, of_day + (3 * round + i - 1) * field);
      EXPECT_EQ(time_code(r), i == 1 ? "10:20:30:12:1" : "10:20:30:13:1");
      if (round > 0 || i == 3) continue;
      ASSERT_EQ(source->receive(r, 0ns), Event::malformed) << "reported in the first round";
      EXPECT_THAT(describe(r.fault), HasSubstr("line 5: "));
    }
  }
  EXPECT_EQ(source->statistics().malformed, 1U);
}

TEST_F(PlayFile, AMalformedLineEndsItThereAndIsNamed) {
  auto settings = take_of(5000);
  test::write_text(path, test::read_text(path) + "oops\n1 1 2 3 4 5 6 50 0 0 0 0 5 8 5001\n");
  settings.speed = 0;
  const auto source = open_source(settings, 50.0);
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  for (std::uint64_t i = 1; i <= 5000; ++i) {
    ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    ASSERT_EQ(counter(r), i);
  }
  EXPECT_EQ(source->receive(r, 0ns), Event::failed);
  EXPECT_EQ(source->receive(r, 0ns), Event::failed);
  EXPECT_EQ(source->statistics().state, SourceState::failed);
  EXPECT_THAT(source->statistics().error, testing::StartsWith(path + ":5004: "));
}

TEST_F(PlayFile, PlaybackBeginsBeforeTheTakeIsRead) {
  auto settings = take_of(50'000);
  settings.speed = 0;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  const std::int64_t before = test::bytes_read();
  const auto source = open_source(settings, 50.0);
  Reception r;
  for (int i = 0; i < 3; ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  const std::int64_t read = test::bytes_read() - before;
  EXPECT_LT(read, 64 * 1024);
  EXPECT_GT(size, 20 * 64 * 1024);
}

TEST_F(PlayFile, ALoopOverATakeThatWasEmptiedEnds) {
  for (const bool lenient : {false, true}) {
    auto settings = take_of(2);
    const std::string head = test::read_text(path).substr(0, test::read_text(path).find("\n1 ") + 1);
    settings.speed = 0;
    settings.loop = true;
    settings.lenient = lenient;
    const auto source = open_source(settings, 50.0);
    Reception r;
    for (int i = 0; i < 3; ++i) ASSERT_EQ(source->receive(r, 0ns), Event::sample);
    test::write_text(path, head + (lenient ? "oops\n" : ""));
    Event event = Event::sample;
    for (int i = 0; i < 3 && event == Event::sample; ++i) event = source->receive(r, 0ns);
    EXPECT_EQ(event, Event::failed);
    EXPECT_EQ(source->statistics().error, path + ": loop=1: the take has no parameters to play");
  }
}

TEST_F(PlayFile, InvalidTakesAreRefusedAtOpening) {
  const auto error_of = [](const SourceSettings& settings, double rate = 50.0) {
    return test::error_of<TransportError>([&] { static_cast<void>(open_source(settings, rate)); });
  };
  auto empty = take_of(0);
  EXPECT_EQ(error_of(empty), "no error");
  empty.loop = true;
  EXPECT_THAT(error_of(empty), HasSubstr("loop=1"));
  auto settings = take_of(1);
  EXPECT_THAT(error_of(settings, 12.0), HasSubstr("10:20:30:12:1"));
  EXPECT_THAT(error_of(settings, 0.0), HasSubstr("rate"));
  EXPECT_THAT(error_of(settings, 1e300), HasSubstr("rate"));
  settings.date = 253'402'214'400;  // 9999-12-31
  EXPECT_THAT(error_of(settings), HasSubstr("date"));
  settings.date.reset();
  settings.speed = -1;
  EXPECT_THAT(error_of(settings), HasSubstr("speed"));
  settings.path += "x";
  settings.speed = 1;
  EXPECT_THAT(error_of(settings), HasSubstr("No such file"));
}

TEST_F(PlayFile, ReadsWhatTheSinkWrote) {
  SinkSettings sink_settings;
  sink_settings.path = *RecordingName::parse(path);
  sink_settings.time_code = {1, 2, 3, 4, 2};
  const auto sink = open_sink(sink_settings);
  wire::CameraParams params;
  params.id = 7;
  params.format = 1;
  params.counter = 5;
  EXPECT_EQ(sink->write(params).error().reason, SinkReason::no_constants);
  auto constants = test::constants_of(test::read_jsonl("field/identified_lp64/constants.jsonl")[0]["fields"]);
  constants.id = params.id;
  ASSERT_TRUE(sink->write(constants));
  ASSERT_TRUE(sink->write(constants));
  ASSERT_TRUE(sink->write(params));
  ASSERT_TRUE(sink->close());
  EXPECT_EQ(sink->statistics().constants, 2u) << "both were written, although the file contains them once";
  EXPECT_EQ(sink->statistics().params, 1u);
  EXPECT_EQ(sink->statistics().errors, 1u);

  SourceSettings settings;
  settings.path = path;
  settings.speed = 0;
  const auto source = open_source(settings, 50.0);
  Reception r;
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(std::get<wire::CameraConstants>(r.sample.record), constants);
  ASSERT_EQ(source->receive(r, 0ns), Event::sample);
  EXPECT_EQ(std::get<wire::CameraParams>(r.sample.record), params);
  EXPECT_EQ(source->receive(r, 0ns), Event::ended);
}

TEST_F(PlayFile, ASinkWithAWrongTimeCodeIsRefused) {
  EXPECT_THROW(static_cast<void>(endpoints::open_sink("file:" + path + "?timecode=25:00:00:00:1")), TransportError);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

}  // namespace trk_bridge::file::file_source_test
