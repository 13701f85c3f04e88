#include "ros/outgoing_diagnostics.h"

#include <cerrno>

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::ros1 {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using ::testing::HasSubstr;

constexpr std::int64_t second = 1'000'000'000;

template <typename... Arguments>
diagnostic_updater::DiagnosticStatusWrapper filled(const std::vector<Finding>& found, const Arguments&... arguments) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  fill(status, found, arguments...);
  return status;
}

std::string value_of(const diagnostic_updater::DiagnosticStatusWrapper& status, const std::string& key) {
  for (const auto& pair : status.values) {
    if (pair.key == key) return pair.value;
  }
  return "no such key";
}

void expect(const diagnostic_updater::DiagnosticStatusWrapper& status, std::uint8_t level, const std::string& text) {
  EXPECT_EQ(int{status.level}, int{level}) << status.message;
  EXPECT_THAT(status.message, HasSubstr(text));
}

class ParamsDiagnostics : public ::testing::Test {
 protected:
  ParamsDiagnostics() {
    form.format = wire::euler;
    now.topic = before.topic = "/crane1/params";
    before.time = 10 * second;
    now.time = 12 * second;
    now.params.received = now.params.outgoing.sets = 100;
    now.params.outgoing.last_set = now.time - second / 50;
    now.params.constants_known = now.params.constants_received = true;
  }

  diagnostic_updater::DiagnosticStatusWrapper status() const {
    return filled(findings(now, before), now, before, form);
  }

  OutgoingForm form;
  ParamsReport now, before;
};

TEST_F(ParamsDiagnostics, SendingIsOkWithItsRate) {
  expect(status(), DiagnosticStatus::OK, "sending at 50.00 Hz");
  EXPECT_EQ(value_of(status(), "rate (Hz)"), "50.00");
  EXPECT_EQ(value_of(status(), "age of last set (s)"), "0.02");
  EXPECT_EQ(value_of(status(), "constants known"), "received");
}

TEST_F(ParamsDiagnostics, NothingEverNamesTheTopic) {
  now.params = {};
  expect(status(), DiagnosticStatus::STALE, "nothing sent yet: no messages on /crane1/params");
}

TEST_F(ParamsDiagnostics, SilenceIsToldWithItsLength) {
  now.params.outgoing.last_set = now.time - 3 * second;
  before.params.received = 100;
  expect(status(), DiagnosticStatus::WARN, "nothing sent for 3.0 s: no newer messages on /crane1/params");
}

TEST_F(ParamsDiagnostics, WhatIsWithheldSaysWhy) {
  now.params.outgoing.last_set = now.time - 3 * second;
  now.params.outgoing.withheld = 100;
  now.params.outgoing.withhold_reason = camera::CameraReason::constants_needed;
  now.params.constants_known = false;
  expect(status(), DiagnosticStatus::WARN, "messages come, but none can be sent");
  expect(status(), DiagnosticStatus::WARN, camera::describe(camera::CameraReason::constants_needed));
  expect(status(), DiagnosticStatus::WARN, "no constants yet");
}

TEST_F(ParamsDiagnostics, OnlyGrowthIsAFinding) {
  now.params.outgoing.dropped = before.params.outgoing.dropped = 5;
  now.params.bad_constants = before.params.bad_constants = 5;
  expect(status(), DiagnosticStatus::OK, "sending");
  ++now.params.outgoing.dropped;
  now.params.outgoing.drop_reason = camera::CameraReason::not_a_rotation;
  expect(status(), DiagnosticStatus::WARN, camera::describe(camera::CameraReason::not_a_rotation));
}

TEST_F(ParamsDiagnostics, AnIdThatIsLeftOutIsToldAndNoFault) {
  now.params.outgoing.left_out_id = 7;
  expect(status(), DiagnosticStatus::OK, "id 7 is left out: the receiver takes none");
}

class TfDiagnostics : public ::testing::Test {
 protected:
  TfDiagnostics() {
    now.info_topic = "/crane1/camera_info";
    before.time = 10 * second;
    now.time = 12 * second;
    now.tf.infos = 100;
    now.tf.outgoing.sets = 100;
    now.tf.outgoing.last_set = now.time - second / 50;
    now.last_pose = 1'700'000'000 * second + second / 50;
  }

  diagnostic_updater::DiagnosticStatusWrapper status() const {
    return filled(findings(now, before, 50), now, before, OutgoingForm{});
  }

  TfReport now, before;
};

TEST_F(TfDiagnostics, SendingIsOk) { expect(status(), DiagnosticStatus::OK, "sending at 50.00 Hz"); }

TEST_F(TfDiagnostics, MissingTfIsToldInItsOwnWordsWithTheTimeSince) {
  now.pose_fault = "\"studio\" does not exist";
  now.tf.outgoing.last_set = now.time - 4 * second;
  expect(status(), DiagnosticStatus::WARN, "nothing sent for 4.0 s: tf: \"studio\" does not exist");
  now.tf.outgoing.sets = 0;
  expect(status(), DiagnosticStatus::STALE, "nothing sent yet: tf: \"studio\" does not exist");
}

TEST_F(TfDiagnostics, StaleTfIsToldWithTheStampOfItsNewestPose) {
  now.tf.outgoing.last_set = now.time - 2 * second;
  expect(status(), DiagnosticStatus::WARN, "nothing sent for 2.0 s: tf is stale, its newest pose is of 1700000000.020");
}

TEST_F(TfDiagnostics, SlowRatesMaySleepLonger) {
  now.tf.outgoing.last_set = now.time - 2 * second;
  EXPECT_EQ(int{findings(now, before, 1).front().level}, int{DiagnosticStatus::OK});
}

TEST_F(TfDiagnostics, MissingAndRefusedCameraInfo) {
  now.tf.infos = 0;
  now.tf.outgoing.sets = 0;
  expect(status(), DiagnosticStatus::STALE, "no camera_info yet on /crane1/camera_info");
  now.tf.infos = 1;
  now.tf.info_is_refused = true;
  now.tf.info_fault = {InfoReason::binned, {}};
  expect(status(), DiagnosticStatus::STALE, "camera_info is refused: binning_x");
}

TEST_F(TfDiagnostics, WhatTheLensLosesIsToldWithItsSize) {
  now.tf.tangential = 1.25;
  now.tf.residual = 0.5;
  now.tf.aspect = 3;
  const auto told = status();
  expect(told, DiagnosticStatus::WARN, "tangential distortion, which trk cannot tell: up to 1.250 px");
  expect(told, DiagnosticStatus::WARN, "k1 and k2 tell the distortion to 0.500 px");
  expect(told, DiagnosticStatus::WARN, "fx and fy do not agree with the chip's size: up to 3.000 px");
  EXPECT_EQ(value_of(told, "lens fit residual (px)"), "0.500");
  EXPECT_EQ(value_of(told, "tangential lost (px)"), "1.250");
}

class SinkDiagnostics : public ::testing::Test {
 protected:
  SinkDiagnostics() {
    now.name = "file take.trk";
    before.time = 10 * second;
    now.time = 12 * second;
    now.sink.counts.params = 100;
    now.sink.last_success = now.time - second / 50;
  }

  void fail(std::uint64_t sets) {
    now.sink.fails = true;
    now.sink.failed_sets = now.sink.counts.errors = sets;
    now.sink.last_fault = {transport::SinkReason::system, {}, ENOSPC};
    now.sink.last_failure = now.time;
  }

  diagnostic_updater::DiagnosticStatusWrapper status() const { return filled(findings(now, before), now, before); }

  SinkReport now, before;
};

TEST_F(SinkDiagnostics, SendingIsOkWithItsRate) {
  expect(status(), DiagnosticStatus::OK, "sending at 50.00 Hz");
  EXPECT_EQ(value_of(status(), "sent"), "100");
  EXPECT_EQ(value_of(status(), "last error"), "none");
}

TEST_F(SinkDiagnostics, NothingWrittenYet) {
  now.sink = {};
  expect(status(), DiagnosticStatus::OK, "open, nothing written yet");
}

TEST_F(SinkDiagnostics, NothingThatGoesOutIsAnError) {
  fail(10);
  now.sink.last_success = before.time - 1;
  expect(status(), DiagnosticStatus::ERROR, "nothing goes out: the system refused: No space left on device");
  EXPECT_EQ(value_of(status(), "errors"), "10");
}

TEST_F(SinkDiagnostics, SomeThatDoNotAreAWarning) {
  fail(3);
  expect(status(), DiagnosticStatus::WARN, "3 sets did not go out whole: the system refused");
}

TEST_F(SinkDiagnostics, AfterwardsItIsInOrderAndTheErrorIsRemembered) {
  fail(3);
  now.sink.fails = false;
  before.sink.failed_sets = 3;
  expect(status(), DiagnosticStatus::OK, "sending");
  EXPECT_THAT(value_of(status(), "last error"), HasSubstr("No space left on device"));
}

}  // namespace
}  // namespace trk_bridge::ros1
