// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "bridge/diagnostics.h"

#include <gmock/gmock.h>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::bridge::diagnostics_test {

using ::testing::HasSubstr;
using ::testing::Not;
using transport::SourceState;

constexpr std::int64_t second = 1'000'000'000;

class Diagnostics : public ::testing::Test {
 protected:
  Diagnostics() {
    now.source_name = before.source_name = "udp port 7000";
    before.time = 10 * second;
    now.time = 12 * second;
    now.source.state = SourceState::receiving;
    now.camera.constants = ConstantsOrigin::own;
    now.camera.sequence.accepted = 100;
    now.camera.last_new = now.time - second / 50;
  }

  Status status() {
    Status s;
    fill(s, findings(now, before, options, 50), now, before);
    return s;
  }

  std::string value(const std::string& key) {
    for (const auto& [known, text] : status().values) {
      if (known == key) return text;
    }
    return "no such key";
  }

  void expect(Level level, const std::string& text) {
    const auto s = status();
    EXPECT_EQ(static_cast<int>(s.level), static_cast<int>(level)) << s.message;
    EXPECT_THAT(s.message, HasSubstr(text));
  }

  CameraOptions options;
  CameraReport now, before;
};

TEST_F(Diagnostics, ReceivingIsOkWithItsRate) {
  expect(Level::ok, "receiving from");
  EXPECT_EQ(value("rate (Hz)"), "50.00");
  EXPECT_EQ(value("age of last sample (s)"), "0.02");
  EXPECT_EQ(status().hardware_id, "udp port 7000");
}

TEST_F(Diagnostics, NothingReceivedIsStaleAndNamesWhatItWaitsFor) {
  now.camera = {};
  now.source.state = SourceState::waiting;
  now.source.waiting_for = "slot 7: no segment";
  expect(Level::stale, "slot 7: no segment");
  EXPECT_EQ(value("age of last sample (s)"), "never");
}

TEST_F(Diagnostics, DatagramsThatAreNotTrk) {
  now.camera = {};
  now.source.state = SourceState::nothing_valid;
  now.source.malformed = 3;
  now.reader.has_fault = true;
  now.reader.last_fault = wire::Fault{wire::Reason::bad_magic};
  expect(Level::warn, "datagrams arrive, but none is trk: " + wire::describe({wire::Reason::bad_magic}));
  EXPECT_EQ(value("malformed"), "3");
}

TEST_F(Diagnostics, SendersThatAreNotAllowed) {
  now.camera = {};
  now.source.state = SourceState::only_refused;
  now.source.last_refused = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 50123};
  expect(Level::warn, "only from senders that are not allowed, last 192.0.2.7:50123");
}

TEST_F(Diagnostics, SendersThatAreNotAllowedBesideOneThatIs) {
  now.source.refused = 1;
  now.source.last_refused = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 50123};
  expect(Level::warn, "receiving from");
  expect(Level::warn, "datagrams from senders that are not allowed, last 192.0.2.7:50123");
}

TEST_F(Diagnostics, OtherIdsOnly) {
  now.camera = {};
  options.id = 7;
  now.reader.unknown_id_records = 5;
  now.reader.unknown_ids = {3, 4};
  now.reader.unknown_id_count = 2;
  expect(Level::warn, "none with id 7; seen: 3, 4");
}

TEST_F(Diagnostics, TheOriginOfStampsAndTheRhythmOfTheCounter) {
  options.stamp = StampMode::counter;
  auto& camera = now.camera;
  camera.stamp_state = StampState::learning;
  EXPECT_EQ(value("stamps"), "arrival: the counter's rhythm is not learned");
  EXPECT_EQ(value("counter rate (Hz)"), "none yet");
  EXPECT_EQ(value("standard rate (Hz)"), "none");
  camera.stamp_state = StampState::counter;
  camera.rhythm.interval = 1e9 / (60000 / 1001.0) * 1.0001;
  camera.rhythm.jitter_before = 2.1e6;
  camera.rhythm.jitter_after = 0.06e6;
  expect(Level::ok, "receiving from");
  EXPECT_EQ(value("stamps"), "counter");
  EXPECT_EQ(value("counter rate (Hz)"), "59.934067");
  EXPECT_EQ(value("standard rate (Hz)"), "59.94");
  EXPECT_EQ(value("off standard rate (ppm)"), "-99.99");
  EXPECT_EQ(value("jitter of arrivals (ms)"), "2.100");
  EXPECT_EQ(value("jitter of stamps (ms)"), "0.060");
  camera.stamp_state = StampState::arrival;
  EXPECT_EQ(value("jitter of stamps (ms)"), "2.100");
  camera.rhythm.interval = 1e9 / 75;
  EXPECT_EQ(value("standard rate (Hz)"), "none");
  EXPECT_EQ(value("off standard rate (ppm)"), "none");
}

TEST_F(Diagnostics, StepsRestartsAndRateChangesOfTheCounterWarnIfStampsFollowIt) {
  now.camera.stamp_state = StampState::counter;
  now.camera.rhythm.steps = now.camera.rhythm.restarts = now.camera.rhythm.rate_changes = 1;
  now.camera.rhythm.last_step = -3.2e6;
  options.stamp = StampMode::arrival;
  expect(Level::ok, "receiving from");
  options.stamp = StampMode::counter;
  expect(Level::warn, "the delay of the path became 3.200 ms shorter");
  expect(Level::warn, "the counter restarted or jumped");
  expect(Level::warn, "the counter's rate changed");
  EXPECT_EQ(value("delay steps"), "1");
  EXPECT_EQ(value("counter restarts"), "1");
  EXPECT_EQ(value("rate changes"), "1");
  before = now;
  now.camera.last_new = now.time += second;
  expect(Level::ok, "receiving from");
}

TEST_F(Diagnostics, ReasonsWhyStampsAreArrivals) {
  options.stamp = StampMode::counter;
  now.camera.stamp_state = StampState::uncounted;
  now.camera.sequence.state = base::CounterState::frozen;
  EXPECT_EQ(value("stamps"), "arrival: the counter stands still");
  now.camera.stamp_state = StampState::no_counter;
  now.camera.sequence.state = base::CounterState::counts;
  EXPECT_EQ(value("stamps"), "arrival: the records have no counter");
  expect(Level::ok, "the records have no counter: stamps are arrivals");
  options.stamp = StampMode::source;
  now.camera.stamp_state = StampState::no_source_time;
  EXPECT_EQ(value("stamps"), "arrival: the records have no time of the sender");
  expect(Level::warn, "stamp: source, but the records have no time of the sender: stamps are arrivals");
}

TEST_F(Diagnostics, StampsOfTheSenderAreNamed) {
  options.stamp = StampMode::source;
  now.camera.stamp_state = StampState::source;
  EXPECT_EQ(value("stamps"), "source");
  expect(Level::ok, "receiving from");
}

TEST_F(Diagnostics, ASenderClockOnTaiIsNamed) {
  EXPECT_EQ(value("sender's time behind (s)"), "none");
  now.camera.source_behind = -37 * second + 30'000'000;
  expect(Level::warn, "the sender's time is 37.0 s ahead of this machine's clock: one is TAI (PTP), the other UTC");
  now.camera.source_behind = 37 * second + 30'000'000;
  expect(Level::warn, "the sender's time is 37.0 s behind this machine's clock: one is TAI (PTP), the other UTC");
  now.camera.source_behind = 12 * second;
  expect(Level::warn, "the sender's time is 12.0 s behind this machine's clock");
  EXPECT_THAT(status().message, Not(HasSubstr("TAI")));
  now.camera.source_behind = 30'000'000;
  expect(Level::ok, "receiving from");
  EXPECT_EQ(value("sender's time behind (s)"), "0.030000");
}

TEST_F(Diagnostics, ASilenceOfMoreThanASecondWarns) {
  now.camera.last_new = now.time - 3 * second;
  expect(Level::warn, "nothing new for 3.0 s");
}

TEST_F(Diagnostics, ACounterThatStandsStillIsNamed) {
  now.camera.last_new = now.time - 3 * second;
  now.camera.sequence.duplicates = 150;
  expect(Level::warn, "counter stands still");
}

TEST_F(Diagnostics, ASecondSenderIsNamedWithTheOneThatIsFollowed) {
  now.camera.foreign = 50;
  now.camera.sender = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 5000};
  now.camera.foreign_sender = {transport::SenderKind::ipv4, {192, 0, 2, 8}, 6000};
  expect(Level::warn, "records of a second sender, 192.0.2.8:6000, are ignored: this camera follows 192.0.2.7:5000");
  EXPECT_EQ(value("foreign"), "50");
}

TEST_F(Diagnostics, ASenderWithManyPortsIsNamed) {
  now.camera.ignores_ports = true;
  expect(Level::warn, "the sender changes its port with every datagram: senders are distinguished by their address");
}

TEST_F(Diagnostics, AnIdThatChangesIsNamedWithTheRemedy) {
  now.camera.id_changes = 1;
  expect(Level::warn, "the id changes: set the id that this camera should follow");
}

TEST_F(Diagnostics, AFailoverIsAnEventThatNamesBoth) {
  now.camera.failovers = 1;
  now.camera.silent_sender = {transport::SenderKind::ipv4, {192, 0, 2, 7}, 5000};
  now.camera.sender = {transport::SenderKind::ipv4, {192, 0, 2, 8}, 6000};
  expect(Level::warn, "192.0.2.7:5000 was silent for 0.5 s or more: 192.0.2.8:6000 is followed now");
  EXPECT_TRUE(findings(now, before, options, 50)[1].is_event);
}

TEST_F(Diagnostics, ACounterThatDoesNotCountIsNamed) {
  now.camera.sequence.state = base::CounterState::frozen;
  expect(Level::warn, "the counter stands still: records are published in order of arrival");
  EXPECT_EQ(value("counter"), "stands still");
  now.camera.sequence.state = base::CounterState::cycles;
  expect(Level::warn, "the counter restarts every few records");
  now.camera.sequence.state = base::CounterState::ignored;
  EXPECT_EQ(status().level, Level::ok) << "as the parameter says";
}

TEST_F(Diagnostics, AClockThatWentBackIsNamedOnce) {
  now.camera.clock_steps = 1;
  now.camera.clock_step = 3600 * second;
  expect(Level::warn, "the clock went back by 3600.0 s: stamps follow it");
  before.camera.clock_steps = 1;
  EXPECT_EQ(status().level, Level::ok);
}

TEST_F(Diagnostics, AFailedSourceIsAnErrorWithItsReason) {
  now.source.state = SourceState::failed;
  now.source.error = "udp port 7000: the network is down";
  expect(Level::error, "the network is down");
  EXPECT_EQ(value("last error"), "udp port 7000: the network is down");
}

TEST_F(Diagnostics, AFileThatEndedIsOk) {
  now.source.state = SourceState::ended;
  expect(Level::ok, "ended");
}

TEST_F(Diagnostics, NoConstantsYet) {
  now.camera.constants = ConstantsOrigin::none;
  expect(Level::warn, "no constants yet");
  options.publish_camera_info = false;
  expect(Level::ok, "receiving");
}

TEST_F(Diagnostics, WithheldNamesTheFormatThatNeedsConstants) {
  now.camera.constants = ConstantsOrigin::none;
  now.camera.withheld = 100;
  now.camera.withhold_reason = camera::CameraReason::constants_needed;
  now.camera.last_format = wire::euler | wire::field_of_view;
  expect(Level::warn, "no constants yet: format 'euler");
  EXPECT_EQ(value("withheld"), "100");
}

TEST_F(Diagnostics, WithheldNamesAnyOtherReason) {
  now.camera.withheld = 1;
  now.camera.withhold_reason = camera::CameraReason::bad_field_of_view;
  expect(Level::warn, "params withheld: " + camera::describe(camera::CameraReason::bad_field_of_view));
}

TEST_F(Diagnostics, InvalidConstantsAreNamed) {
  now.camera.bad_constants = 1;
  expect(Level::warn, "constants ignored: " + camera::describe(camera::CameraReason::bad_constants));
}

TEST_F(Diagnostics, OnlyGrowthIsAFinding) {
  for (auto* report : {&now, &before}) {
    report->source.malformed = 4;
    report->source.kernel_drops = 4;
    report->source.refused = 4;
    report->reader.unknown_id_records = 4;
    report->camera.sequence.lost = 4;
    report->camera.dropped = 4;
    report->camera.bad_constants = 4;
    report->camera.held_stamps = 4;
    report->camera.id_changes = 4;
  }
  expect(Level::ok, "receiving");
  EXPECT_EQ(value("lost"), "4");

  ++now.camera.sequence.lost;
  expect(Level::warn, "lost 1");
  ++now.source.kernel_drops;
  expect(Level::warn, "the kernel dropped");
  ++now.camera.dropped;
  now.camera.drop_reason = camera::CameraReason::not_a_rotation;
  expect(Level::warn, camera::describe(camera::CameraReason::not_a_rotation));
}

TEST_F(Diagnostics, TheReceiveBufferIsTheGrantedOne) {
  EXPECT_EQ(value("receive buffer"), "none") << "shared memory and files have none";
  now.source.receive_buffer = now.source.wanted_buffer = 8388608;
  EXPECT_EQ(value("receive buffer"), "8388608 bytes");
  now.source.receive_buffer = 212992;
  EXPECT_EQ(value("receive buffer"), "212992 of 8388608 bytes: net.core.rmem_max allows no more");
  now.source.kernel_drops = before.source.kernel_drops + 1;
  expect(Level::warn, "net.core.rmem_max");
}

TEST_F(Diagnostics, NoCameraInfoSaysWhy) {
  now.camera.without_camera_info = 100;
  now.camera.info_reason = camera::CameraReason::not_monotonic;
  expect(Level::warn, "no camera_info: " + camera::describe(camera::CameraReason::not_monotonic));
}

TEST_F(Diagnostics, ALensThatCameraInfoDescribesInexactlyIsShownWithItsError) {
  now.camera.has_camera_info = true;
  now.camera.fit_residual = 0.01;
  expect(Level::ok, "receiving");
  now.camera.fit_residual = 0.047;
  expect(Level::warn, "camera_info describes the distortion with an error of up to 0.047 px");
  now.camera.has_camera_info = false;
  expect(Level::ok, "receiving");
}

TEST_F(Diagnostics, TheEncodingIsThatOfTheLastNewRecord) {
  now.camera.encoding = "binary identified_lp64, layout guessed";
  EXPECT_EQ(value("encoding"), "binary identified_lp64, layout guessed");
  now.camera = {};
  EXPECT_EQ(value("encoding"), "none yet");
}

TEST_F(Diagnostics, RecordsWithoutALensAreOkAndNamed) {
  now.camera.constants = ConstantsOrigin::none;
  now.camera.has_lens = false;
  now.camera.without_lens = 100;
  expect(Level::ok, "the records have no lens");
  EXPECT_THAT(status().message, Not(HasSubstr("constants")));
  EXPECT_EQ(value("without lens"), "100");
  EXPECT_EQ(value("camera_info"), "no: the records have no lens");
}

TEST_F(Diagnostics, RecordsAcceptedDespiteAFaultAreAWarning) {
  now.source.doubtful = before.source.doubtful = 5;
  now.source.last_doubt = before.source.last_doubt = "wrong checksum";
  expect(Level::ok, "receiving");
  now.source.doubtful = 6;
  expect(Level::warn, "records are accepted despite: wrong checksum");
  EXPECT_EQ(value("accepted despite a fault"), "6");
}

TEST_F(Diagnostics, NoMarkersSaysWhy) {
  now.markers.not_drawn = before.markers.not_drawn = 5;
  expect(Level::ok, "receiving");
  now.markers.not_drawn = 6;
  now.markers.reason = {InfoReason::no_lens, camera::CameraReason::too_wide};
  expect(Level::warn, "no markers: " + camera::describe(camera::CameraReason::too_wide));
}

}  // namespace trk_bridge::bridge::diagnostics_test
