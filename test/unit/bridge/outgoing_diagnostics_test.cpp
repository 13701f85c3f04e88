// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/outgoing_diagnostics.h"

#include <cerrno>

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge::outgoing_diagnostics_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t second = 1'000'000'000;

template <typename Report>
Status filled(const std::vector<Finding>& found, const Report& now, const Report& before) {
  Status status;
  fill(status, found, now, before);
  return status;
}

std::string value_of(const Status& status, const std::string& key) {
  for (const auto& [known, value] : status.values) {
    if (known == key) return value;
  }
  return "no such key";
}

void expect(const Status& status, Level level, const std::string& text) {
  EXPECT_EQ(status.level, level) << status.message;
  EXPECT_THAT(status.message, HasSubstr(text));
}

class ParamsDiagnostics : public ::testing::Test {
 protected:
  ParamsDiagnostics() {
    now.topic = before.topic = "/crane1/params";
    before.time = 10 * second;
    now.time = 12 * second;
    now.params.received = 100;
    now.params.last_received = now.time - second / 50;
    now.params.constants = ConstantsOrigin::own;
  }

  Status status() const { return filled(findings(now, before), now, before); }

  ParamsReport now, before;
};

TEST_F(ParamsDiagnostics, SendingIsOkWithItsRate) {
  expect(status(), Level::ok, "sending at 50.00 Hz");
  EXPECT_EQ(value_of(status(), "rate (Hz)"), "50.00");
  EXPECT_EQ(value_of(status(), "age of last set (s)"), "0.02");
  EXPECT_EQ(value_of(status(), "constants known"), "received");
}

TEST_F(ParamsDiagnostics, NothingReceivedNamesTheTopic) {
  now.params = {};
  expect(status(), Level::stale, "nothing sent yet: no messages on /crane1/params");
}

TEST_F(ParamsDiagnostics, SilenceIsShownWithItsLength) {
  now.params.last_received = now.time - 3 * second;
  before.params.received = 100;
  expect(status(), Level::warn, "nothing sent for 3.0 s: no newer messages on /crane1/params");
}

TEST_F(ParamsDiagnostics, MissingConstantsAreAFinding) {
  now.params.constants = ConstantsOrigin::none;
  expect(status(), Level::warn, "sending at 50.00 Hz; no constants yet");
  EXPECT_EQ(value_of(status(), "constants known"), "no");
}

TEST_F(ParamsDiagnostics, OnlyGrowthIsAFinding) {
  now.params.bad_constants = before.params.bad_constants = 5;
  expect(status(), Level::ok, "sending");
  ++now.params.bad_constants;
  expect(status(), Level::warn, camera::describe(camera::CameraReason::bad_constants));
}

class TfDiagnostics : public ::testing::Test {
 protected:
  TfDiagnostics() {
    now.info_topic = "/crane1/camera_info";
    before.time = 10 * second;
    now.time = 12 * second;
    now.tf.infos = 100;
    now.tf.sets = 100;
    now.tf.last_set = now.time - second / 50;
    now.last_pose = 1'700'000'000 * second + second / 50;
  }

  Status status() const { return filled(findings(now, before, 50), now, before); }

  TfReport now, before;
};

TEST_F(TfDiagnostics, SendingIsOk) { expect(status(), Level::ok, "sending at 50.00 Hz"); }

TEST_F(TfDiagnostics, MissingTfIsShownWithItsReasonAndDuration) {
  now.pose_fault = "\"studio\" does not exist";
  now.tf.last_set = now.time - 4 * second;
  expect(status(), Level::warn, "nothing sent for 4.0 s: tf: \"studio\" does not exist");
  now.tf.sets = 0;
  expect(status(), Level::stale, "nothing sent yet: tf: \"studio\" does not exist");
}

TEST_F(TfDiagnostics, StaleTfIsShownWithTheStampOfItsNewestPose) {
  now.tf.last_set = now.time - 2 * second;
  expect(status(), Level::warn, "nothing sent for 2.0 s: tf is stale, its newest pose is of 1700000000.020000000");
}

TEST_F(TfDiagnostics, ClocksThatWereFollowedOrRefusedAreShownWithTheReason) {
  now.filter.refused = 1;
  now.filter.last_refused = {StampJump::Kind::ahead, "crane1", "/crane_driver", 1e6};
  expect(status(), Level::warn,
         "sending at 50.00 Hz; transforms refused: the stamps of frame crane1 from /crane_driver are 1000000.0 s ahead "
         "of ROS time");
  now.filter.restarts = 1;
  now.filter.last_restart = {StampJump::Kind::back, "crane1", "/crane_driver", 60};
  const std::string reason = "the stamps of frame crane1 from /crane_driver went back by 60.0 s";
  expect(status(), Level::warn, "tf was cleared and continues: " + reason);
  EXPECT_THAT(status().message, Not(HasSubstr("refused")));
  EXPECT_EQ(value_of(status(), "last tf restart"), reason);
  before.filter = now.filter;
  expect(status(), Level::ok, "sending");
}

TEST_F(TfDiagnostics, ClocksThatDifferAreShown) {
  now.ahead = 3600 * second;
  expect(status(), Level::warn, "the stamps of tf are 3600.0 s ahead of ROS time: check the clocks");
  now.ahead = -60 * second;
  expect(status(), Level::warn, "the stamps of tf are 60.0 s behind ROS time: check the clocks");
  now.ahead = -second / 5;
  expect(status(), Level::ok, "sending");
  EXPECT_EQ(value_of(status(), "tf ahead of ROS time (s)"), "-0.20");
}

TEST_F(TfDiagnostics, SlowRatesMayBeSilentLonger) {
  now.tf.last_set = now.time - 2 * second;
  EXPECT_EQ(findings(now, before, 1).front().level, Level::ok);
}

TEST_F(TfDiagnostics, MissingAndRefusedCameraInfo) {
  now.tf.infos = 0;
  now.tf.sets = 0;
  expect(status(), Level::stale, "no camera_info yet on /crane1/camera_info");
  now.tf.infos = 1;
  now.tf.info_is_refused = true;
  now.tf.info_fault = {InfoReason::no_size, {}};
  expect(status(), Level::stale, "camera_info is refused: width and height must be from 1 to 2147483647");
}

TEST_F(TfDiagnostics, ARefusedCameraInfoIsASeparateCondition) {
  now.tf.info_is_refused = true;
  now.tf.info_fault = {InfoReason::unknown_model, {}};
  EXPECT_EQ(findings(now, before, 50).front().condition, Condition::bad_camera_info);
  expect(status(), Level::warn, "camera_info is refused: " + describe(now.tf.info_fault));
  now.tf.sets = 0;
  EXPECT_EQ(findings(now, before, 50).front().condition, Condition::bad_camera_info);
}

TEST_F(TfDiagnostics, InvalidLensesAreAWarning) {
  now.tf.bad_lenses = before.tf.bad_lenses = 2;
  expect(status(), Level::ok, "sending");
  now.tf.bad_lenses = 3;
  expect(status(), Level::warn, "messages on lens ignored: focus or aperture is not finite");
}

TEST_F(TfDiagnostics, WhatTheLensLosesIsShownWithItsSize) {
  now.tf.tangential = 1.25;
  now.tf.residual = 0.5;
  now.tf.aspect = 3;
  const auto shown = status();
  expect(shown, Level::warn, "tangential distortion, which trk cannot represent: up to 1.250 px");
  expect(shown, Level::warn, "k1 and k2 describe the distortion with an error of up to 0.500 px");
  expect(shown, Level::warn, "fx and fy do not agree with the chip's size: up to 3.000 px");
  EXPECT_EQ(value_of(shown, "lens fit residual (px)"), "0.500");
  EXPECT_EQ(value_of(shown, "tangential lost (px)"), "1.250");
}

TEST_F(TfDiagnostics, AnInvalidPoseIsNotReportedAsStaleTf) {
  now.tf.last_set = now.time - 2 * second;
  now.tf.dropped = 3;
  now.tf.drop_reason = camera::CameraReason::not_finite;
  expect(status(), Level::warn, "nothing sent for 2.0 s: " + camera::describe(camera::CameraReason::not_finite));
  EXPECT_EQ(value_of(status(), "dropped"), "3");
}

class SinkDiagnostics : public ::testing::Test {
 protected:
  SinkDiagnostics() {
    now.state.name = "file take.trk";
    now.state.is_open = true;
    now.form.format = wire::euler;
    before.time = 10 * second;
    now.time = 12 * second;
    now.sink.sent.params = 100;
    now.sink.last_success = now.time - second / 50;
  }

  void fail(std::uint64_t sets) {
    now.sink.fails = true;
    now.sink.failed_sets = now.sink.sent.errors = sets;
    now.sink.last_fault = {transport::SinkReason::system, {}, ENOSPC};
    now.sink.last_failure = now.time;
  }

  Status status() const { return filled(findings(now, before), now, before); }

  SinkReport now, before;
};

TEST_F(SinkDiagnostics, SendingIsOkWithItsRate) {
  expect(status(), Level::ok, "sending at 50.00 Hz");
  EXPECT_EQ(value_of(status(), "sent"), "100");
  EXPECT_EQ(value_of(status(), "last error"), "none");
}

TEST_F(SinkDiagnostics, ADelayHasItsMarginAndAge) {
  now.form.delay = transport::Delay{40'000'000, 40'000'000, 20'000'000};
  before.departures.emplace();
  now.departures = DepartureStatistics{200, now.time, 0, 200 * 40.5e6, 200, 8, 200 * 0.97, 3};
  expect(status(), Level::ok, "sending at 50.00 Hz");
  EXPECT_EQ(value_of(status(), "delay (s)"), "position 0.04, rotation 0.04, lens 0.02");
  EXPECT_EQ(value_of(status(), "lead (s)"), "0");
  EXPECT_EQ(value_of(status(), "margin (fields)"), "0.97");
  EXPECT_EQ(value_of(status(), "negative margins"), "8");
  EXPECT_EQ(value_of(status(), "age of what is sent (ms)"), "40.50");
  EXPECT_EQ(value_of(status(), "duplicate or late samples left out"), "3");
}

TEST_F(SinkDiagnostics, ADelayShorterThanTheLatencyIsAWarning) {
  now.form.delay = transport::Delay{6'000'000, 6'000'000, 6'000'000};
  before.departures = DepartureStatistics{100, before.time, 0, 0, 100, 90, 0, 0};
  now.departures = DepartureStatistics{200, now.time, 0, 100 * 12e6, 200, 190, -100 * 0.32, 0};
  expect(status(), Level::warn, "100 of 100 sets were older than the delay");
  expect(status(), Level::warn, "margin -0.32 fields");
  EXPECT_EQ(value_of(status(), "delay (s)"), "0.006");
  now.form.delay.reset();
  expect(status(), Level::ok, "sending");
}

TEST_F(SinkDiagnostics, ASinkWithoutPaceHasNoMargin) {
  EXPECT_EQ(value_of(status(), "margin (fields)"), "no such key");
}

TEST_F(SinkDiagnostics, NothingWrittenYet) {
  now.sink = {};
  expect(status(), Level::ok, "open, nothing written yet");
}

TEST_F(SinkDiagnostics, ASinkThatIsNotOpenIsNotReportedAsOpen) {
  now.sink = {};
  now.state.is_open = false;
  expect(status(), Level::ok, "is being opened");
}

TEST_F(SinkDiagnostics, ASinkThatCannotBeOpenedIsAnErrorWithTheReason) {
  now.state.is_open = false;
  now.state.cannot_open = "take.trk: cannot be written: it exists";
  fail(10);
  expect(status(), Level::error, "nothing is sent: take.trk: cannot be written: it exists");
}

TEST_F(SinkDiagnostics, AWriteThatTakesLongIsAnErrorWhileItLasts) {
  now.queue = before.queue = OutletQueueStatistics{120, 0, false};
  now.state.busy_since = now.time - second / 2;
  expect(status(), Level::ok, "sending");
  now.state.busy_since = now.time - 5 * second / 2;
  expect(status(), Level::error, "nothing is sent: no answer for 2.5 s; 120 records wait");
}

TEST_F(SinkDiagnostics, ANoticeIsShownAndIsNotAFault) {
  now.state.notice = "recovered from an interrupted recording: take.recovered.trk";
  expect(status(), Level::ok, "take.recovered.trk");
}

TEST_F(SinkDiagnostics, SendingNothingIsAnError) {
  fail(10);
  now.sink.last_success = before.time - 1;
  expect(status(), Level::error, "nothing is sent: the system refused: No space left on device");
  EXPECT_EQ(value_of(status(), "errors"), "10");
}

TEST_F(SinkDiagnostics, FailedSetsAreAWarning) {
  fail(3);
  expect(status(), Level::warn, "3 sets were not sent completely: the system refused");
}

TEST_F(SinkDiagnostics, AfterwardsItIsOkAndTheErrorIsKept) {
  fail(3);
  now.sink.fails = false;
  before.sink.failed_sets = 3;
  expect(status(), Level::ok, "sending");
  EXPECT_THAT(value_of(status(), "last error"), HasSubstr("No space left on device"));
}

TEST_F(SinkDiagnostics, FormatAndIdAreTheSinksOwn) {
  now.sink.last_id = 7;
  EXPECT_EQ(value_of(status(), "format"), wire::format_to_words(wire::euler));
  EXPECT_EQ(value_of(status(), "id"), "7");
  now.sink.sent.params = 0;
  now.form.format.reset();
  EXPECT_EQ(value_of(status(), "format"), "as received");
  EXPECT_EQ(value_of(status(), "id"), "none yet");
}

TEST_F(SinkDiagnostics, WhatIsWithheldSaysWhy) {
  now.sink.withheld = 100;
  now.sink.withhold_reason = camera::CameraReason::constants_needed;
  expect(status(), Level::warn, "sending at 50.00 Hz; not sent, cannot be converted to the format: ");
  expect(status(), Level::warn, camera::describe(camera::CameraReason::constants_needed));
  now.sink.sent.params = 0;
  expect(status(), Level::warn, camera::describe(camera::CameraReason::constants_needed));
  EXPECT_THAT(status().message, Not(HasSubstr("sending")));
  EXPECT_EQ(value_of(status(), "withheld"), "100");
}

TEST_F(SinkDiagnostics, RefusedConstantsAreCounted) {
  now.sink.refused_constants = 3;
  EXPECT_EQ(value_of(status(), "constants refused"), "3");
}

TEST_F(SinkDiagnostics, OnlyGrowthIsAFinding) {
  now.sink.dropped = before.sink.dropped = 5;
  now.sink.withheld = before.sink.withheld = 5;
  now.queue = before.queue = OutletQueueStatistics{3, 5, false};
  expect(status(), Level::ok, "sending");
  ++now.sink.dropped;
  now.sink.drop_reason = camera::CameraReason::not_a_rotation;
  expect(status(), Level::warn, "not sent: " + camera::describe(camera::CameraReason::not_a_rotation));
  EXPECT_EQ(value_of(status(), "dropped"), "6");
}

TEST_F(SinkDiagnostics, AnIdThatIsNotSentIsShownAndIsNotAFault) {
  now.sink.unsent_id = 7;
  expect(status(), Level::ok, "id 7 is not sent: the receiver accepts no ids");
}

TEST_F(SinkDiagnostics, QueuesAreShownIfThereAreAny) {
  EXPECT_EQ(value_of(status(), "queued"), "no such key");
  now.queue = before.queue = OutletQueueStatistics{3, 5, false};
  now.queue->drops = 9;
  expect(status(), Level::warn, "4 records not sent: the oldest parameters were dropped");
  EXPECT_EQ(value_of(status(), "queued"), "3");
  EXPECT_EQ(value_of(status(), "queue drops"), "9");
}

TEST_F(SinkDiagnostics, ARecordingThatCouldNotKeepUpStaysAnError) {
  now.queue = before.queue = OutletQueueStatistics{0, 9, true};
  expect(status(), Level::error, "the recording has ended, because the sink could not keep up");
  expect(status(), Level::error, "9 records are missing");
}

}  // namespace trk_bridge::bridge::outgoing_diagnostics_test
